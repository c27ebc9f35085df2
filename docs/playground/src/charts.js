// Charts by uPlot: lines, bands, and what the page's colours are.
/* global uPlot */

const HEIGHT = 190;
const MOST = 3000; // points of a line
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
export const line = (name, width = 1.5, more = {}) => ({ stroke: colour(name), width, points: { show: false }, ...more });
const edge = () => ({ stroke: "transparent", width: 0, points: { show: false } });
const label = (value) => (value === 0 ? "0" : Number(value.toPrecision(5)).toString().replace(/e\+?/, "e"));

let shown = new Set();

function axes(log) {
  const common = { stroke: colour("faint"), grid: { stroke: colour("grid"), width: 1 }, ticks: { show: false } };
  const whole = (u, values) => values.map((value) => (Number.isInteger(value) ? value.toString() : ""));
  const all = (u, values) => values.map((value) => (value === null ? "" : label(value)));
  const grid = log ? { show: false } : common.grid; // there would be ten lines a decade
  return [{ ...common, values: whole, space: 80, size: 26 }, { ...common, grid, size: 68, values: all }];
}

/**
 * A chart in `place`.
 *
 * @param data x and the series, arrays of numbers, NaN as null
 * @param series one of `line` or `edge` each
 */
export function chart(place, data, series, { bands = [], range, log = false, marks = [] } = {}) {
  const y = { ...(range ? { range } : {}), ...(log ? { distr: 3, log: 10 } : {}) };
  const options = {
    width: Math.max(place.clientWidth, 200),
    height: HEIGHT,
    scales: { x: { time: false }, y },
    axes: axes(log),
    series: [{}, ...series],
    bands,
    cursor: { drag: { x: true, y: false } },
    legend: { show: false },
    hooks: { drawClear: [(u) => marks.forEach((mark) => shade(u, mark()))] },
  };
  place.replaceChildren();
  const plot = new uPlot(options, data, place);
  shown = new Set([...shown].filter((each) => each.place.isConnected && each.place !== place)).add({ place, plot });
  return plot;
}

/** Shades stretches of x, [from, to] each. */
function shade(u, stretches) {
  u.ctx.save();
  u.ctx.fillStyle = colour("grid");
  for (const [from, to] of stretches) {
    const left = Math.max(u.valToPos(from, "x", true), u.bbox.left);
    const right = Math.min(u.valToPos(to, "x", true), u.bbox.left + u.bbox.width);
    if (right > left) u.ctx.fillRect(left, u.bbox.top, right - left, u.bbox.height);
  }
  u.ctx.restore();
}

/** An estimate with the band of two standard errors. */
export function banded(place, rows, estimate, error) {
  const known = (value) => (Number.isFinite(value) ? value : null);
  const at = thin(rows.length);
  const [x, middle] = [at.map((k) => rows[k]), at.map((k) => known(estimate(k)))];
  const low = at.map((k) => known(estimate(k) - 2 * error(k)));
  const high = at.map((k) => known(estimate(k) + 2 * error(k)));
  chart(place, [x, middle, low, high], [line("blue"), edge(), edge()], {
    bands: [{ series: [3, 2], fill: colour("band") }],
    range: () => usual(middle, high),
  });
}

/** The range of most estimates and of a usual band: a wild one at the start must not flatten the others. */
function usual(middle, high) {
  const sorted = (values) => values.slice().sort((a, b) => a - b);
  const at = (values, share) => values[Math.floor(share * (values.length - 1))];
  const known = sorted(middle.filter((value) => value !== null));
  if (!known.length) return [0, 1];
  const halves = sorted(middle.flatMap((value, k) => (high[k] > value ? [high[k] - value] : [])));
  const [low, top] = [at(known, 0.02), at(known, 0.98)];
  const room = halves.length ? 1.5 * at(halves, 0.5) : 0;
  const spare = room + 0.05 * (top - low) || 0.05 * Math.abs(top) || 1;
  return [low - spare, top + spare];
}

/** Places of at most so many of `total` rows, the last one among them. */
export function thin(total) {
  const step = Math.max(1, Math.ceil(total / MOST));
  const places = [];
  for (let k = 0; k < total; k += step) places.push(k);
  if (places[places.length - 1] !== total - 1) places.push(total - 1);
  return places;
}

export function redraw() {
  for (const { place, plot } of shown) {
    if (place.clientWidth) plot.setSize({ width: Math.max(place.clientWidth, 200), height: HEIGHT });
  }
}

addEventListener("resize", redraw);
