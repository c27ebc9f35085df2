// An example that is computed here: a plant of first order whose gain falls, driven by random steps.
import { normal } from "./windup.js";

const ROWS = 1500;

export function plantTable() {
  const random = normal(7);
  const [u, y] = [new Float64Array(ROWS), new Float64Array(ROWS)];
  for (let k = 0; k < ROWS; k++) {
    u[k] = k % 20 === 0 ? random() : u[Math.max(k - 1, 0)];
    if (k) y[k] = 0.9 * y[k - 1] + (k < 700 ? 0.5 : 0.3) * u[k - 1] + 0.02 * random();
  }
  const column = (name, values) => ({ name, unit: "", values, fault: "" });
  return { columns: [column("u", u), column("y", y)], rows: ROWS };
}
