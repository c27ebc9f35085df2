// The variance of the noise, and how long a rule remembers, from errors and leverages.

/** The plain mean of e²/(1 + leverage) over the samples used but the first n; NaN before. */
export function runningNoise({ error, leverage }, n, used) {
  let [seen, total, count] = [0, 0, 0];
  return Float64Array.from(error, (e, k) => {
    if (used[k] && ++seen > n) {
      total += (e * e) / (1 + leverage[k]);
      count++;
    }
    return count ? total / count : NaN;
  });
}

/** n over the part s/(1 + s) that a sample decides of its own fit, s being the leverage. */
export function memoryOf(leverage, n) {
  let own = 0;
  for (const s of leverage) own += s / (1 + s);
  own = leverage.length ? own / leverage.length : 0;
  return own > 0 ? n / own : Infinity;
}
