// What an identification found, on the page.
import { banded, chart, line, thin } from "./charts.js";
import { byId, element } from "./controls.js";
import { brief } from "./finding.js";

const DRAWN = 12; // parameters that have a chart
const BANK =
  "P of a bank holds what members disagree about that hardly count: it makes no band. Choose a rule to see one; " +
  "the command estimates one for the bank, too.";

export function show(found, judgement) {
  byId("results").hidden = false;
  byId("fault").hidden = true;
  verdict(judgement);
  facts(found);
  signals(found);
  parameters(found);
}

/** What is wrong, in the place of results. */
export function refuse(error) {
  byId("fault").textContent = error.message || String(error);
  byId("fault").hidden = false;
  byId("results").hidden = true;
}

function verdict({ severity, verdict: words, findings }) {
  byId("verdict").className = severity;
  byId("verdict-words").textContent = words;
  const items = findings.map(({ severity: each, text, advice }) =>
    element("li", { class: each }, text, advice ? element("em", {}, ` ${advice}`) : ""),
  );
  byId("findings").replaceChildren(...items);
}

function facts(found) {
  const { all } = found.scores;
  const used = found.used.reduce((sum, each) => sum + each, 0);
  const memory = Number.isFinite(found.memory) ? `${brief(found.memory)} samples` : "the whole record";
  const pairs = [
    ["samples used", `${used} of ${found.used.length}`],
    ["memory", memory],
    ["one-step error (rms)", brief(all.model)],
    ["of repeating the last value", brief(all.lastValue)],
    ["of never forgetting", brief(all.noForgetting)],
    ["fit", all.mean > 0 ? `${(100 * (1 - all.model / all.mean)).toFixed(1)} %` : "not defined"],
  ];
  byId("facts").replaceChildren(
    ...pairs.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))),
  );
}

function signals({ samples, prediction, trace, outputName, deviation }) {
  const known = (value) => (Number.isFinite(value) ? value : null);
  const at = thin(samples.y.length);
  const rows = at.map((k) => k + 1);
  byId("signal-title").textContent = `${outputName}: measured and predicted one step ahead`;
  const series = [line("faint", 1), line("blue")];
  chart(byId("signal"), [rows, at.map((k) => known(samples.y[k])), at.map((k) => known(prediction[k]))], series);
  const spread = at.map((k) => known(2 * deviation(k)));
  const errors = at.map((k) => known(trace.error[k]));
  const less = spread.map((value) => (value === null ? null : -value));
  chart(byId("error"), [rows, errors, less, spread], [line("vermillion", 1), line("faint", 1), line("faint", 1)], {
    range: () => around(errors, spread),
  });
}

function around(errors, spread) {
  const sizes = errors.filter((value) => value !== null).map(Math.abs).sort((a, b) => a - b);
  const end = Math.max(sizes[Math.floor(0.99 * (sizes.length - 1))] || 0, spread[spread.length - 1] || 0);
  return end > 0 ? [-1.2 * end, 1.2 * end] : [-1, 1];
}

function parameters({ samples, trace, standardError, theta, n, isBank }) {
  const rows = Array.from({ length: samples.y.length }, (_, k) => k + 1);
  const more = samples.names.length - DRAWN;
  const drawn = more > 0 ? `the first ${DRAWN} of ${samples.names.length} are drawn` : "";
  byId("more").textContent = isBank ? `${BANK} ${drawn}` : drawn;
  byId("parameters-title").textContent = isBank ? "Parameters" : "Parameters, with two standard errors";
  const cards = samples.names.slice(0, DRAWN).map((name, i) => {
    const error = standardError[standardError.length - n + i];
    const after = isBank ? "" : ` ± ${brief(error)}`;
    const value = element("p", { class: "value" }, digits(theta[i]), element("span", {}, after));
    const spot = element("div", { class: "chart" });
    return { spot, card: element("div", { class: "card" }, element("h3", {}, name), value, spot) };
  });
  byId("parameters").replaceChildren(...cards.map((each) => each.card));
  cards.forEach(({ spot }, i) =>
    banded(spot, rows, (k) => trace.theta[k * n + i], (k) => (isBank ? 0 : standardError[k * n + i])),
  );
}

const digits = (value) => Number(value.toPrecision(5)).toString();
