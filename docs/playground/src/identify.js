// Runs an estimator over samples and keeps what the page shows.
import { Bank, RLS } from "forgetting";
import { memoryOf, runningNoise } from "./noise.js";
import { moved, originOf, thetaBack, variance } from "./origin.js";
import { part } from "./samples.js";
import { scores, settledRows } from "./scores.js";

const PIECES = 1000; // P is looked at after each
const OUTPUTS = ["theta", "error", "forgetting_factor", "leverage", "skipped", "windup", "variance"];

/**
 * What a rule makes of samples.
 *
 * @param samples see samplesOf
 * @param rule "auto" for the bank, or a rule as `RLS` takes it
 */
export function identify(samples, rule) {
  const origin = originOf(samples);
  const here = moved(samples, origin);
  const { n } = samples;
  const estimator = rule === "auto" ? new Bank(n) : new RLS(n, { rule, monitor: true });
  try {
    const initial = diagonal(estimator.covariance, n);
    const trace = run(estimator, here, rule === "auto");
    const units = estimator.units || new Float64Array(n).fill(1);
    const found = { samples, here, rule, trace, n, isBank: rule === "auto" };
    found.initialVariance = initial.map((value, i) => value / (units[i] * units[i]));
    found.health = rule === "auto" ? undefined : estimator.health();
    found.used = trace.skipped.map((code) => (code === 0 ? 1 : 0));
    found.noise = runningNoise(trace, n, found.used);
    found.least = leastVariances(trace.variance, n);
    found.memory = memory(found);
    found.plain = errorsOf(new RLS(n, { rule: "none" }), here);
    found.alone = withoutInputs(here, samples.past, rule);
    found.settled = settledRows(found);
    found.scores = scores(found);
    back(found, origin);
    return found;
  } finally {
    estimator.free();
  }
}

/** The record in pieces, as many bits the same as in one; P after each. */
function run(estimator, { phi, y, n }, isBank) {
  const T = y.length;
  const length = Math.max(1, Math.ceil(T / PIECES));
  const outputs = isBank ? [...OUTPUTS, "memory"] : OUTPUTS;
  const [pieces, rows, covariances] = [[], [], []];
  for (let start = 0; start < T; start += length) {
    const stop = Math.min(start + length, T);
    pieces.push(inRows(start, () =>
      estimator.run(phi.subarray(start * n, stop * n), y.subarray(start, stop), { outputs, missing: "skip" }),
    ));
    rows.push(stop - 1);
    covariances.push(estimator.covariance);
  }
  const trace = { rows, covariances };
  for (const name of outputs) trace[name] = joined(pieces.map((piece) => piece[name]));
  return trace;
}

/** Turns "sample 3" of a piece into a row of the record. */
function inRows(start, call) {
  try {
    return call();
  } catch (error) {
    error.message = error.message.replace(/\bsample (\d+)/, (_, k) => `row ${start + Number(k) + 1}`);
    throw error;
  }
}

function joined(parts) {
  const all = new parts[0].constructor(parts.reduce((length, each) => length + each.length, 0));
  let start = 0;
  for (const each of parts) {
    all.set(each, start);
    start += each.length;
  }
  return all;
}

function errorsOf(estimator, { phi, y }) {
  try {
    return estimator.run(phi, y, { outputs: ["error"], missing: "skip" }).error;
  } finally {
    estimator.free();
  }
}

/** One-step errors of the same rule on past outputs and the constant alone; null where that is the model. */
function withoutInputs(here, past, rule) {
  const { phi, n, complete } = here;
  if (!past.length) return null;
  const first = complete.indexOf(true);
  const isConstant = (i) => complete.every((there, k) => !there || phi[k * n + i] === phi[first * n + i]);
  const kept = Array.from({ length: n }, (_, i) => i).filter((i) => past.includes(i) || isConstant(i));
  if (kept.length === n) return null;
  const few = kept.length;
  try {
    return errorsOf(rule === "auto" ? new Bank(few) : new RLS(few, { rule, monitor: true }), part(here, n, kept));
  } catch {
    return null; // the rule has settings for each parameter
  }
}

/** Samples that the estimate stands on at the end; infinite if nothing is forgotten. */
function memory({ trace, n, used, least }) {
  if (trace.memory) return trace.memory[trace.memory.length - 1];
  const grown = lastRow(trace.variance, n).some((value, i) => value > least[i]);
  if (!grown && trace.forgetting_factor.every((factor, k) => !used[k] || factor === 1)) return Infinity;
  const leverage = trace.leverage.filter((_, k) => used[k]);
  const late = leverage.subarray(leverage.length - Math.max(Math.floor(leverage.length / 4), 1));
  return memoryOf(late, n);
}

function leastVariances(variances, n) {
  const least = new Float64Array(n).fill(Infinity);
  variances.forEach((value, place) => (least[place % n] = Math.min(least[place % n], value)));
  return least;
}

/** Estimates and variances in terms of the samples: that of the constant drawn straight between two looks. */
function back(found, origin) {
  const { trace, n } = found;
  thetaBack(trace.theta, n, origin);
  if (origin.column >= 0) {
    const ends = trace.covariances.map((P) => variance(P, n, origin));
    between(trace.rows, ends, (k, value) => (trace.variance[k * n + origin.column] = value));
  }
  found.theta = lastRow(trace.theta, n);
  found.standardError = Float64Array.from(trace.variance, (value, place) =>
    Math.sqrt(value * found.noise[Math.floor(place / n)]),
  );
  // P of members that do not count swells the leverage of a bank: its errors alone say how large they are
  const leverage = found.isBank ? new Float64Array(trace.leverage.length) : trace.leverage;
  const noise = found.isBank ? runningNoise({ error: trace.error, leverage }, n, found.used) : found.noise;
  found.deviation = (k) => (k ? Math.sqrt(noise[k - 1] * (1 + leverage[k])) : NaN);
  found.spread = leverage.map((s) => Math.sqrt(1 + s));
  found.prediction = found.samples.y.map((value, k) => value - trace.error[k]);
}

function between(rows, values, take) {
  let piece = 0;
  for (let k = 0; k <= rows[rows.length - 1]; k++) {
    if (k > rows[piece]) piece++;
    const [end, start] = [rows[piece], piece ? rows[piece - 1] : rows[piece]];
    const share = end > start ? (k - start) / (end - start) : 1;
    take(k, piece && k < end ? values[piece - 1] + share * (values[piece] - values[piece - 1]) : values[piece]);
  }
}

const lastRow = (numbers, n) => numbers.slice(numbers.length - n);
const diagonal = (P, n) => Float64Array.from({ length: n }, (_, i) => P[i * n + i]);
