// What speaks for and against an estimate: the findings of the package's judge that need no more than the
// run itself, with its limits and its words.
import { brief, finding, listing, percent } from "./finding.js";
import { memoryOf } from "./noise.js";
import { ownPast, whiteness } from "./whiteness.js";

const RANK = { wrong: 0, warning: 1, good: 2 };
const CAUSES = ["regressors", "residuals", "memory", "windup", "excitation", "intervals", "baselines", "samples"];
const HEADLINES = {
  good: "Good: nothing found speaks against this estimate.",
  warning: "Use with care.",
  wrong: "Do not rely on this.",
};
const LASTING = 1000; // growth of P beyond which information ends the alarm, but not the doubt
const UNLEARNED = 0.1; // share of the initial variance above which a parameter counts as not learned
const ROUNDING = 1e-4; // errors below this share of the output's own changes are only rounding
const BOUNDED = "Take a rule with a bounded covariance, such as subspace, or the bank.";

/** All findings, the worst first, and the verdict in a line. */
export function judge(found) {
  const all = [blind(found), windup(found), excitation(found), memory(found), leftOut(found), ...ofOutput(found)];
  const findings = all
    .filter(Boolean)
    .sort((a, b) => RANK[a.severity] - RANK[b.severity] || CAUSES.indexOf(a.name) - CAUSES.indexOf(b.name));
  const { severity, advice, text } = findings[0];
  const first = severity === "good" ? "" : ` First: ${advice || text}`;
  return { severity, verdict: HEADLINES[severity] + first, findings };
}

function silent({ samples: { phi, complete, names, n } }) {
  return names.map((_, i) => complete.every((there, k) => !there || phi[k * n + i] === 0));
}

function blind(found) {
  const names = found.samples.names.filter((_, i) => silent(found)[i]);
  if (!names.length) return null;
  const text =
    `Not excited: ${listing(names)}; the regressor is zero in every complete sample, so the value shown is ` +
    "only the initial one.";
  return finding("regressors", "warning", text, "Leave it out, or record while it moves.");
}

function windup({ trace, health, samples }) {
  const first = trace.windup.indexOf(1);
  const growth = health ? health.growth : 1;
  const along = health ? ` of ${involved(health, samples.names)}` : "";
  if (first < 0 && growth <= LASTING) {
    return finding("windup", "good", "No windup: P did not grow without information.");
  }
  if (first < 0) {
    const text = `The variance${along} is still ${brief(growth)} times what it was when informed.`;
    return finding("windup", "warning", text, "Wait for excitation before using it.");
  }
  const rows = trace.windup.reduce((sum, each) => sum + each, 0);
  const text =
    `Windup: the rule kept forgetting while the input did not excite, in ${rows} samples, first in row ${first + 1}`;
  if (trace.windup[trace.windup.length - 1]) {
    return finding("windup", "wrong", `${text}, and still at the end.`, BOUNDED);
  }
  if (growth > LASTING) {
    const still = `the variance${along} is still ${brief(growth)} times what it was before`;
    return finding("windup", "wrong", `${text}; ${still}.`, BOUNDED);
  }
  return finding("windup", "warning", `${text}, but not at the end.`, BOUNDED);
}

/** The weakest direction by the names of its parameters. */
function involved(health, names) {
  const size = health.direction.map((part, i) => Math.abs(part) / Math.sqrt(health.least_variances[i]));
  const strong = names.filter((_, i) => size[i] > 0.3 * Math.max(...size));
  return strong.length === 1 ? strong[0] : `the combination of ${strong.join(" and ")}`;
}

function excitation(found) {
  const { samples, least, initialVariance, health } = found;
  const mute = silent(found);
  if (mute.every(Boolean)) return null;
  const weak = samples.names.flatMap((name, i) => {
    const share = least[i] / initialVariance[i];
    return !mute[i] && share > UNLEARNED
      ? [`${name} (variance in P never below ${brief(share)} times the initial one)`]
      : [];
  });
  if (weak.length) {
    const advice = "Excite more, remember longer, or leave out what cannot be learned.";
    return finding("excitation", "warning", `Weakly excited: ${listing(weak)}.`, advice);
  }
  if (health && (health.status === "unexcited" || health.status === "windup")) {
    const text = `Not excited at the end: nothing informs about ${involved(health, samples.names)} now.`;
    return finding("excitation", "warning", text, "Use it as the last known value.");
  }
  return finding("excitation", "good", "All parameters were excited.");
}

function memory(found) {
  const { n, trace, settled } = found;
  const used = found.used.reduce((sum, each) => sum + each, 0);
  if (used < 5 * n) {
    const text = `Only ${used} samples were used for ${n} parameters: little can be judged.`;
    return finding("memory", "warning", text, "Record longer.");
  }
  const typical = trace.memory
    ? median(trace.memory.filter((_, k) => settled[k]))
    : memoryOf(trace.leverage.filter((_, k) => settled[k]), n);
  const { model, noForgetting } = found.scores.settled;
  return ofLength(typical, n, model > 0 ? noForgetting / model : 1);
}

function ofLength(samples, n, gain) {
  if (!(samples >= 0)) return null;
  const long = Number.isFinite(samples) ? `${brief(samples)} samples` : "all samples";
  const figure = `the estimate of ${n} parameters stands on about ${long}`;
  if (samples >= 5 * n) return finding("memory", "good", `Long enough a memory: ${figure}.`);
  const advice = "Add what moves the output to the model, or remember longer.";
  if (samples >= 2 * n && !(gain > 3)) return finding("memory", "warning", `The memory is short: ${figure}.`, advice);
  const text =
    `The model is wrong, and carried by forgetting: ${figure}, and without forgetting its error is ` +
    `${brief(gain)} times as large; it follows the output rather than explaining it.`;
  return finding("memory", "wrong", text, advice);
}

function leftOut({ trace }) {
  const count = trace.skipped.reduce((sum, code) => sum + (code === 1 ? 1 : 0), 0);
  if (!count) return null;
  const text =
    `${count} samples carried less information than the rule's threshold; they were neither learned nor ` +
    "forgotten, and the estimates were held.";
  return finding("samples", "good", text);
}

function ofOutput(found) {
  const of = found.outputName;
  const { model, lastValue, mean } = found.scores.settled;
  const beside = baselines(found.scores.settled, of);
  if (!(model > ROUNDING * Math.min(lastValue, mean))) {
    return [beside, finding("residuals", "good", `The one-step errors of ${of} are negligible.`)];
  }
  const { spread } = found;
  const error = found.trace.error.map((e, k) => (found.settled[k] ? e : NaN));
  const predicted = spread.map((_, k) => found.deviation(k));
  const lags = found.samples.past.length;
  const past = ownPast(error.map((e, k) => e / spread[k]), lags);
  return [beside, intervals(error, predicted, of), whiteness(past, of, lags)];
}

function baselines({ model, lastValue, mean, withoutInputs }, of) {
  if (![model, lastValue, mean].every(Number.isFinite)) return null;
  if (model >= mean && mean > 0) {
    const text =
      `The model is of no use: its one-step error of ${of} is ${brief(model / mean)} times that of predicting ` +
      "the mean so far.";
    return finding("baselines", "wrong", text, "Look for other inputs, or for a mistake in the record.");
  }
  if (model >= lastValue && lastValue > 0) {
    const text =
      `Repeating the last value of ${of} is better: the model's one-step error is ` +
      `${brief(model / lastValue)} times as large.`;
    return finding("baselines", "warning", text, "To predict, add past outputs; to learn a parameter, this may be right.");
  }
  if (withoutInputs !== null && model > 0.99 * withoutInputs) {
    const text =
      `The inputs bring nothing: without them the error of ${of} is ${brief(withoutInputs / model)} times as large.`;
    return finding("baselines", "warning", text, "Check the input and its delay nk.");
  }
  const ratio = lastValue > 0 ? brief(model / lastValue) : "not comparable";
  const more = withoutInputs === null ? "" : `, ${brief(model / withoutInputs)} times that without inputs`;
  const text = `The one-step error of ${of} is ${ratio} times that of repeating the last value${more}.`;
  return finding("baselines", "good", text);
}

function intervals(errors, predicted, of) {
  const rows = Array.from(errors.keys()).filter((k) => Number.isFinite(errors[k]) && Number.isFinite(predicted[k]));
  if (rows.length < 50) return null;
  const inside = rows.filter((k) => Math.abs(errors[k]) <= 2 * predicted[k]).length / rows.length;
  const chance = Math.sqrt((0.9545 * 0.0455) / rows.length);
  const figure =
    `${percent(inside, 1)} of the errors of ${of} are within two predicted standard deviations ` +
    "(95.5% would be right)";
  if ((inside >= 0.9 && inside <= 0.985) || Math.abs(inside - 0.9545) < 3 * chance) {
    return finding("intervals", "good", `Intervals hold: ${figure}.`);
  }
  if (inside > 0.985) return finding("intervals", "good", `Intervals are wide: ${figure}.`);
  const advice = "Take the printed ± for a lower bound; the noise changes or the model lacks something.";
  return finding("intervals", inside < 0.75 ? "wrong" : "warning", `Intervals are too narrow: ${figure}.`, advice);
}

function median(values) {
  const sorted = Float64Array.from(values).sort();
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}
