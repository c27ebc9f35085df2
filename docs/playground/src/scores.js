// Root mean square one-step errors: the model beside what knows nothing, on the same samples.

/** Samples used after the start, whose errors show the initial guess. */
export function settledRows({ n, used }) {
  const start = 5 * n + 20;
  const total = used.reduce((sum, each) => sum + each, 0);
  let seen = 0;
  return Array.from(used, (each) => {
    seen += each;
    return each === 1 && seen > (total >= 2 * start ? start : 1);
  });
}

/** Scores over all complete samples but the first n, and over those that are settled. */
export function scores(found) {
  const { samples, n } = found;
  let seen = 0;
  const started = samples.complete.map((there) => there && ++seen > n);
  return { all: score(found, started), settled: score(found, started.map((yes, k) => yes && found.settled[k])) };
}

function score({ samples: { y }, trace, plain, alone }, among) {
  const previous = lastMeasured(y);
  const rows = among.flatMap((yes, k) => (yes && !Number.isNaN(previous[k]) ? [k] : []));
  const level = rows.reduce((sum, k) => sum + y[k], 0) / rows.length;
  const rms = (error) => Math.sqrt(rows.reduce((sum, k) => sum + error(k) ** 2, 0) / rows.length);
  return {
    samples: rows.length,
    model: rms((k) => trace.error[k]),
    lastValue: rms((k) => y[k] - previous[k]),
    mean: rms((k) => y[k] - level),
    noForgetting: rms((k) => plain[k]),
    withoutInputs: alone && rms((k) => alone[k]),
  };
}

/** For each row the latest value before it; NaN where there is none. */
function lastMeasured(y) {
  let latest = NaN;
  return Array.from(y, (value) => {
    const before = latest;
    if (!Number.isNaN(value)) latest = value;
    return before;
  });
}
