// From the text of a file to columns of numbers.
import Papa from "papaparse";

const MISSING = new Set(["", "na", "n/a", "nan", "null", "none", "-", "?"]);
const LARGEST = 200e6; // bytes; more than this is work for the command

/** The text of a file in UTF-8, UTF-16 with its mark, or else Windows-1252. */
export function decode(bytes) {
  if (bytes.length > LARGEST) throw new Error(`the file has ${bytes.length} bytes, allowed: up to ${LARGEST}`);
  const marks = { "255,254": "utf-16le", "254,255": "utf-16be" };
  const encoding = marks[`${bytes[0]},${bytes[1]}`] || "utf-8";
  let text;
  try {
    text = new TextDecoder(encoding, { fatal: true }).decode(bytes);
  } catch {
    text = new TextDecoder("windows-1252").decode(bytes);
  }
  if (text.includes("\0")) throw new Error("the file is no text; a playground reads CSV");
  return text;
}

/**
 * The columns of a table in text.
 *
 * @returns {{columns: {name: string, unit: string, values: Float64Array | null, fault: string}[], rows: number}}
 *     NaN is a missing value; `values` is null where a cell is no number, and `fault` says which.
 */
export function read(text) {
  const parsed = Papa.parse(text.replace(/^\uFEFF/, ""), { comments: "#", skipEmptyLines: "greedy" });
  const rows = parsed.data;
  if (!rows.length) throw new Error("the file is empty");
  const decimalComma = parsed.meta.delimiter !== ",";
  const number = (cell) => toNumber(cell, decimalComma);
  const named = !rows[0].some((cell) => Number.isFinite(number(cell)));
  const names = named ? rows[0] : rows[0].map((_, place) => `column ${place + 1}`);
  const units = named && rows.length > 2 && isUnits(rows[1], rows[2], number) ? rows[1] : [];
  const first = (named ? 1 : 0) + (units.length ? 1 : 0);
  const body = rows.slice(first);
  if (!body.length) throw new Error("the file has names of columns, and no rows");
  const columns = unique(names).map((name, place) => ({
    name,
    unit: (units[place] || "").trim(),
    ...column(body, place, number),
  }));
  if (!columns.some((each) => each.values)) throw new Error("no column of the file holds numbers only");
  return { columns, rows: body.length };
}

/** A number, NaN where it is missing, and undefined where the cell holds something else. */
function toNumber(cell, decimalComma) {
  const words = (cell ?? "").trim();
  if (MISSING.has(words.toLowerCase())) return NaN;
  const value = Number(decimalComma ? words.replace(",", ".") : words);
  return Number.isFinite(value) ? value : undefined;
}

/** Whether a row is of units: no number in it, some word, and a number in the next. */
function isUnits(row, next, number) {
  const isNumber = (cell) => Number.isFinite(number(cell));
  return row.some((cell) => number(cell) === undefined) && !row.some(isNumber) && next.some(isNumber);
}

function column(body, place, number) {
  const values = new Float64Array(body.length);
  for (let row = 0; row < body.length; row++) {
    const value = number(body[row][place]);
    if (value === undefined) {
      const fault = `row ${row + 1} has "${body[row][place].slice(0, 30)}", which is no number`;
      return { values: null, fault };
    }
    values[row] = value;
  }
  return { values, fault: "" };
}

/** Names without blanks around them, those that stand twice told apart. */
function unique(names) {
  const seen = new Map();
  return names.map((given, place) => {
    const name = given.trim() || `column ${place + 1}`;
    const count = (seen.get(name) || 0) + 1;
    seen.set(name, count);
    return count > 1 ? `${name} (${count})` : name;
  });
}
