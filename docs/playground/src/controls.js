// Small pieces of the form. Names of columns come from files: they are only ever set as text.

/** An element with attributes and children; text is text. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && typeof value !== "string") made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

export const byId = (id) => document.getElementById(id);

/** A label with the control in it. */
export const labelled = (words, control, hint = "") =>
  element("label", { class: "field" }, element("span", {}, words), control, element("small", {}, hint));

export function select(options, chosen) {
  const made = element("select");
  for (const { value, words, group } of options) {
    const option = element("option", { value }, words ?? value);
    place(made, group).append(option);
  }
  if (chosen !== undefined) made.value = chosen;
  return made;
}

function place(made, group) {
  if (!group) return made;
  const known = [...made.querySelectorAll("optgroup")].find((each) => each.label === group);
  if (known) return known;
  made.append(element("optgroup", { label: group }));
  return made.lastChild;
}

/** The slider's place for a factor: equal steps multiply the memory 1/(1 − λ) by the same. */
export const toSlider = (factor) => (factor >= 1 ? 1000 : Math.round((-Math.log10(1 - factor) / 5) * 999));
export const fromSlider = (place) => (place >= 1000 ? 1 : Number((1 - 10 ** ((-5 * place) / 999)).toPrecision(5)));
