// From columns to regressors and outputs, as the record of the Python package makes them.

/** A column `lag` rows later; NaN before the record. */
export function delayed(values, lag) {
  const shifted = new Float64Array(values.length).fill(NaN);
  shifted.set(values.subarray(0, Math.max(values.length - lag, 0)), Math.min(lag, values.length));
  return shifted;
}

/**
 * The samples of a model.
 *
 * @param {{output: Column, inputs: Column[], kind: "linear" | "arx", constant: boolean, na: number, nb: number, nk: number}} model
 * @returns {{phi: Float64Array, y: Float64Array, names: string[], n: number, past: number[], complete: boolean[]}}
 *     `phi` row by row, `past` the columns of phi that are past outputs.
 */
export function samplesOf(model) {
  const made = model.kind === "arx" ? dynamics(model) : regression(model);
  const { columns, names } = made;
  const [T, n] = [model.output.values.length, columns.length];
  if (!n) throw new Error("the model has no regressor: choose an input, past outputs or a constant");
  const phi = new Float64Array(T * n);
  columns.forEach((column, i) => column.forEach((value, k) => (phi[k * n + i] = value)));
  const y = Float64Array.from(model.output.values);
  const complete = Array.from(y, (value, k) => !Number.isNaN(value) && isComplete(phi, k, n));
  if (!complete.includes(true)) throw new Error("in no row all values are there that the model needs");
  return { phi, y, names, n, past: made.past, complete };
}

function regression({ output, inputs, constant }) {
  const columns = inputs.map((input) => input.values);
  const names = inputs.map((input) => input.name);
  if (!constant) return { columns, names, past: [] };
  const ones = new Float64Array(output.values.length).fill(1);
  return { columns: [ones, ...columns], names: ["Intercept", ...names], past: [] };
}

function dynamics({ output, inputs, constant, na, nb, nk }) {
  const [columns, names] = [[], []];
  for (let lag = 1; lag <= na; lag++) {
    columns.push(delayed(output.values, lag));
    names.push(`${output.name}(k-${lag})`);
  }
  for (let lag = nk; inputs.length && lag < nk + nb; lag++) {
    for (const input of inputs) {
      columns.push(delayed(input.values, lag));
      names.push(lag ? `${input.name}(k-${lag})` : `${input.name}(k)`);
    }
  }
  const past = Array.from({ length: na }, (_, i) => i);
  if (!constant) return { columns, names, past };
  const ones = Float64Array.from(output.values, (_, k) =>
    columns.some((column) => Number.isNaN(column[k])) ? NaN : 1,
  );
  return { columns: [...columns, ones], names: [...names, "offset"], past };
}

function isComplete(phi, k, n) {
  for (let i = 0; i < n; i++) if (Number.isNaN(phi[k * n + i])) return false;
  return true;
}

/** These columns of phi alone. */
export function part({ phi, y, complete }, n, kept) {
  const T = y.length;
  const chosen = new Float64Array(T * kept.length);
  for (let k = 0; k < T; k++) kept.forEach((i, place) => (chosen[k * kept.length + place] = phi[k * n + i]));
  return { phi: chosen, y, complete, n: kept.length };
}
