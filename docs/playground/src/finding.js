// A finding, and how its figures are written.

/** One thing found: a sentence with the figure, and what to do; severity "good", "warning" or "wrong". */
export const finding = (name, severity, text, advice = "") => ({ name, severity, text, advice });

export const percent = (share, digits) => `${(100 * share).toFixed(digits)}%`;

/** Three digits. */
export const brief = (value) => (Number.isFinite(value) ? Number(value.toPrecision(3)).toString() : String(value));

/** Joins names as a person would, at most eight of them. */
export function listing(names) {
  if (names.length > 8) return `${names.slice(0, 8).join(", ")} and ${names.length - 8} more`;
  return names.length === 1 ? names[0] : `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}
