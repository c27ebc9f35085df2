// Where a model with a constant measures from: its first complete sample in the place of zero.
//
// A model y = c + φθ says the same of y − y₀ and φ − φ₀, with another c. Measured from the first
// sample, large columns that vary little lose no digits, and nothing depends on where a unit has its zero.

/** The constant's column and the point; `column` is -1 where there is no constant, and nothing is moved. */
export function originOf({ phi, y, n, complete }) {
  const rows = complete.flatMap((there, k) => (there ? [k] : []));
  const nowhere = { column: -1, level: 1, phi: new Float64Array(n), y: 0 };
  if (rows.length < 2) return nowhere;
  const first = phi.slice(rows[0] * n, rows[0] * n + n);
  const column = first.findIndex((value, i) => value !== 0 && rows.every((k) => phi[k * n + i] === value));
  if (column < 0) return nowhere;
  const level = first[column];
  first[column] = 0;
  return { column, level, phi: first, y: y[rows[0]] };
}

/** The samples, measured from there. */
export function moved(samples, origin) {
  if (origin.column < 0) return samples;
  const { n } = samples;
  return {
    ...samples,
    phi: samples.phi.map((value, place) => value - origin.phi[place % n]),
    y: samples.y.map((value) => value - origin.y),
  };
}

/** Estimates over moved samples in terms of the samples; `theta` (T, n) is changed. */
export function thetaBack(theta, n, origin) {
  if (origin.column < 0) return theta;
  for (let start = 0; start < theta.length; start += n) {
    let sum = origin.phi[0] * theta[start];
    for (let i = 1; i < n; i++) sum += origin.phi[i] * theta[start + i];
    theta[start + origin.column] += (origin.y - sum) / origin.level;
  }
  return theta;
}

/** The variance of the constant in terms of the samples, of P (n, n) over moved ones. */
export function variance(P, n, origin) {
  const row = Array.from(origin.phi, (value, i) => (i === origin.column ? 1 : 0) - value / origin.level);
  let sum = 0;
  for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) sum += row[i] * P[i * n + j] * row[j];
  return sum;
}
