// Whether one-step errors follow from their own past: by the share of their variance that a linear
// prediction from it explains (Yule-Walker, by Levinson's recursion), and by the test of Ljung and Box (1978).
import { finding, percent } from "./finding.js";

const ORDER = 20;
const LAGS = [1, 2, 5, 10, 20];
const FEWEST = 20;

/** What the past of errors says of them, NaN where there is none; null if there are too few. */
export function ownPast(errors, outputLags) {
  const there = Array.from(errors, Number.isFinite);
  const count = there.filter(Boolean).length;
  const e = errors.map((value, k) => (there[k] ? value : 0));
  if (count < FEWEST || e.every((value) => value === 0)) return null;
  const order = Math.max(1, Math.min(ORDER, Math.floor(count / 10)));
  const { covariances, pairs } = lagged(e, there, order);
  const correlations = covariances.map((value) => value / covariances[0]);
  const left = levinson(correlations);
  const share = 1 - (left * (count - 1)) / Math.max(count - order - 1, 1);
  return {
    share: Math.min(Math.max(share, 0), 1),
    correlation: correlations[1],
    probability: ljungBox(correlations, pairs, count, outputLags),
    samples: count,
  };
}

function lagged(e, there, order) {
  const T = e.length;
  const [covariances, pairs] = [[], []];
  for (let lag = 0; lag <= order; lag++) {
    let [sum, count] = [0, 0];
    for (let k = lag; k < T; k++) {
      sum += e[k] * e[k - lag];
      count += there[k] && there[k - lag] ? 1 : 0;
    }
    covariances.push((sum / Math.max(count, 1)) * (1 - lag / T));
    pairs.push(count);
  }
  return { covariances, pairs };
}

/** The share of the variance that the best linear prediction from the past leaves. */
function levinson(correlations) {
  const order = correlations.length - 1;
  const prediction = [];
  let left = 1;
  for (let step = 0; step < order; step++) {
    const known = prediction.reduce((sum, each, i) => sum + each * correlations[step - i], 0);
    const reflection = (correlations[step + 1] - known) / left;
    if (!(Math.abs(reflection) < 1)) break;
    const before = [...prediction].reverse();
    before.forEach((each, i) => (prediction[i] -= reflection * each));
    prediction.push(reflection);
    left *= 1 - reflection * reflection;
  }
  return left;
}

function ljungBox(correlations, pairs, count, outputLags) {
  const found = [];
  for (const lag of LAGS) {
    if (lag <= outputLags || lag >= Math.min(correlations.length, Math.max(Math.floor(count / 4), 2))) continue;
    let sum = 0;
    for (let i = 1; i <= lag; i++) sum += (correlations[i] ** 2 * (count + 2) * count) / Math.max(pairs[i], 1);
    found.push(chiSquaredTail(lag - outputLags, sum));
  }
  return found.length ? Math.min(1, Math.min(...found) * found.length) : 1;
}

/**
 * The probability that chi-squared of `freedom` degrees exceeds x: the upper incomplete gamma function
 * Q(freedom/2, x/2), by its series where x is small and its continued fraction where it is large.
 */
export function chiSquaredTail(freedom, x) {
  const [a, z] = [freedom / 2, x / 2];
  if (!(z > 0)) return 1;
  const front = Math.exp(a * Math.log(z) - z - logGammaOfHalves(freedom));
  return z < a + 1 ? 1 - front * series(a, z) : front * fraction(a, z);
}

function logGammaOfHalves(twice) {
  let value = twice % 2 ? Math.log(Math.PI) / 2 : 0;
  for (let a = twice % 2 ? 0.5 : 1; a < twice / 2; a++) value += Math.log(a);
  return value;
}

function series(a, z) {
  let [term, sum] = [1 / a, 1 / a];
  for (let i = 1; i < 500 && term > sum * 1e-17; i++) {
    term *= z / (a + i);
    sum += term;
  }
  return sum;
}

function fraction(a, z) {
  let value = 0;
  for (let i = 200; i > 0; i--) value = (i * (i - a)) / (z + 2 * i + 1 - a - value);
  return 1 / (z + 1 - a - value);
}

/** The finding on what the past explains. */
export function whiteness(past, of, outputLags) {
  if (!past) return null;
  const certain = !(past.probability > 1e-3);
  const figure =
    `${percent(past.share, 0)} of the variance of the one-step errors of ${of} follows from their own past ` +
    `(correlation of neighbours ${past.correlation.toFixed(2)}, ${past.samples} errors)`;
  const more = outputLags ? "Raise na and nb" : "Add past outputs or inputs to the model";
  if (past.share >= 0.95 && certain) {
    return finding("residuals", "wrong", `The model is wrong: ${figure}.`, `${more}; it lacks the dynamics of ${of}.`);
  }
  if (past.share >= 0.05 && certain) {
    const advice = `${more}, or take the noise for correlated.`;
    return finding("residuals", "warning", `The errors are correlated: ${figure}.`, advice);
  }
  return finding("residuals", "good", `The one-step errors of ${of} are white: ${figure}.`);
}
