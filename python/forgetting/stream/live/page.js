// Draws the events of a stream. Names come from the stream: they are only ever set as text.
"use strict";

const KEPT = 600; // points of a chart
const CHARTS = 12; // parameters that are drawn; all are told by the lines of the command
const HEIGHT = 170;
const byId = (id) => document.getElementById(id);
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const brief = (value) => (value === null ? "not known" : Number(value.toPrecision(5)).toString());

let rows = []; // row numbers, shared by all charts
let charts = []; // { plot, series, take(event) }
let dirty = false;

function axes() {
  const common = { stroke: colour("faint"), grid: { stroke: colour("grid"), width: 1 }, ticks: { show: false } };
  const counted = (u, values) => values.map((value) => (Number.isInteger(value) ? value.toString() : ""));
  return [
    { ...common, values: counted, space: 80, size: 26 },
    { ...common, size: 64, values: (u, values) => values.map((value) => brief(value)) },
  ];
}

// The range of most of the estimates and of a usual band: a single wild one must not flatten the others.
function usual(estimates, high) {
  const known = estimates.filter((value) => value !== null).sort((a, b) => a - b);
  if (!known.length) return [0, 1];
  const at = (sorted, share) => sorted[Math.floor(share * (sorted.length - 1))];
  const halves = estimates.map((value, place) => high[place] - value).filter((half) => half > 0);
  const room = halves.length ? 1.5 * at(halves.sort((a, b) => a - b), 0.5) : 0;
  const [low, top] = [at(known, 0.02), at(known, 0.98)];
  const spare = room + 0.05 * (top - low) || 0.05 * Math.abs(top) || 1;
  return [low - spare, top + spare];
}

// One chart; `lines` are its series, `bands` fill between two of them.
function chart(place, lines, take, bands, range) {
  const options = {
    width: Math.max(place.clientWidth, 200),
    height: HEIGHT,
    scales: { x: { time: false }, y: range ? { range } : {} },
    axes: axes(),
    series: [{}, ...lines],
    bands: bands || [],
    cursor: { drag: { x: false, y: false } },
    legend: { show: false },
  };
  const series = lines.map(() => []);
  const made = { place, series, take, plot: new uPlot(options, [rows, ...series], place) };
  charts.push(made);
}

const line = (name, width) => ({ stroke: colour(name), width: width || 1.5, points: { show: false } });
const edge = () => ({ stroke: "transparent", width: 0, points: { show: false } });

function begin(told) {
  charts.forEach((each) => each.plot.destroy());
  charts = [];
  rows = [];
  byId("model").textContent = told.model;
  byId("parameters").replaceChildren();
  byId("alarms").replaceChildren();
  byId("signal-title").textContent = `${told.outputs[0]}: measured and predicted`;
  const more = told.parameters.length - CHARTS;
  byId("more").textContent = more > 0 ? `the first ${CHARTS}; ${more} more are in the lines of the command` : "";
  chart(byId("signal"), [line("faint", 1), line("blue")], (event) => [event.measured, event.prediction]);
  chart(byId("error"), [line("vermillion", 1), line("vermillion", 1)], (event) => event.error, [
    { series: [2, 1], fill: colour("grid") },
  ]);
  told.parameters.slice(0, CHARTS).forEach(parameter);
  told.alarms.forEach(alarm);
}

function parameter(name, place) {
  const card = document.createElement("div");
  card.className = "card";
  const title = document.createElement("h2");
  title.textContent = name;
  const value = document.createElement("p");
  value.className = "value";
  const spot = document.createElement("div");
  spot.className = "chart";
  card.append(title, value, spot);
  byId("parameters").append(card);
  const take = (event) => {
    const estimate = event.theta[place];
    const error = event.standard_errors ? event.standard_errors[place] : null;
    const note = document.createElement("span");
    note.textContent = error === null ? "" : ` ± ${brief(error)}`;
    value.replaceChildren(brief(estimate), note);
    if (estimate === null || error === null) return [estimate, null, null];
    return [estimate, estimate - 2 * error, estimate + 2 * error];
  };
  chart(spot, [line("blue"), edge(), edge()], take, [{ series: [3, 2], fill: colour("band") }], (u) =>
    usual(u.data[1], u.data[3]));
}

function alarm(told) {
  const item = document.createElement("li");
  const of = told.parameter ? ` ${told.parameter}` : "";
  item.textContent = `row ${told.row}: ${told.alarm}${of} ${told.state}`;
  byId("alarms").querySelectorAll(".none").forEach((each) => each.remove());
  byId("alarms").prepend(item);
  while (byId("alarms").children.length > 100) byId("alarms").lastChild.remove();
}

function active(words) {
  const items = words.map((word) => {
    const item = document.createElement("li");
    item.textContent = word;
    return item;
  });
  byId("active").replaceChildren(...items);
}

function take(event) {
  rows.push(event.row);
  charts.forEach((each) => each.take(event).forEach((value, place) => each.series[place].push(value)));
  if (rows.length > KEPT) {
    rows.shift();
    charts.forEach((each) => each.series.forEach((values) => values.shift()));
  }
  event.alarms.forEach(alarm);
  active(event.active);
  byId("now").textContent = `row ${event.row}` + (event.time === null ? "" : `, time ${event.time}`);
  byId("counts").textContent = event.counts;
  dirty = true;
}

function draw() {
  if (dirty) {
    dirty = false;
    charts.forEach((each) => each.plot.setData([rows, ...each.series]));
  }
  requestAnimationFrame(draw);
}

function resize() {
  charts.forEach((each) => each.plot.setSize({ width: Math.max(each.place.clientWidth, 200), height: HEIGHT }));
}

function connection(words, lost) {
  byId("connection").textContent = words;
  byId("connection").className = lost ? "lost" : "";
}

const source = new EventSource("events");
source.addEventListener("begin", (message) => begin(JSON.parse(message.data)));
source.addEventListener("row", (message) => take(JSON.parse(message.data)));
source.onopen = () => connection("live", false);
source.onerror = () => connection("no connection: the command has ended, or cannot be reached", true);
addEventListener("resize", resize);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => location.reload());
requestAnimationFrame(draw);
