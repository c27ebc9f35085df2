// The choice of a rule: its name, its forgetting factor and its own parameters, from the registry.
import { axes } from "forgetting";
import { byId, element, fromSlider, labelled, select, toSlider } from "./controls.js";

const DEFAULT_FACTOR = 0.98;

/** The rules that need nothing but numbers and words. */
export const rules = () =>
  axes()
    .find((axis) => axis.name === "rule")
    .entries.filter((entry) => !entry.parameters.some((each) => each.required));

/** Fills the choice of a rule and calls `changed` when it changes; returns what says the rule chosen. */
export function ruleForm(changed) {
  const entries = rules();
  const words = { value: "auto", words: "auto: mixes rules of all speeds" };
  const list = select([words, ...entries.map((entry) => ({ value: entry.name }))], "subspace");
  byId("rule").append(labelled("Rule", list));
  const own = () => entries.find((entry) => entry.name === list.value);
  const factor = factorForm(changed);
  let controls = [];
  const show = () => {
    const entry = own();
    byId("rule-words").textContent = entry ? entry.summary : "Nothing to choose: the bank weighs rules by what they have predicted.";
    byId("guarantee").textContent = entry ? guarantee(entry) : "";
    factor.show(Boolean(entry && entry.forgetting_factor));
    controls = entry ? entry.parameters.map((each) => parameterForm(each, changed)) : [];
    byId("rule-parameters").replaceChildren(...controls.map((each) => each.field));
  };
  list.addEventListener("change", () => (show(), changed()));
  show();
  return {
    chosen: () => (own() ? chosen(own(), factor, controls) : "auto"),
    choose: (name) => ((list.value = entries.some((each) => each.name === name) ? name : "auto"), show()),
  };
}

function chosen(entry, factor, controls) {
  const rule = { name: entry.name };
  if (entry.forgetting_factor) rule.forgetting_factor = factor.value();
  for (const control of controls) {
    const value = control.value();
    if (value !== undefined) rule[control.name] = value;
  }
  return rule;
}

function guarantee(entry) {
  return `P bounded above: ${entry.bounded_above}; below: ${entry.bounded_below}. ${entry.cost ? `Cost: ${entry.cost}.` : ""}`;
}

function factorForm(changed) {
  const slider = element("input", { type: "range", min: "100", max: "1000", step: "1", id: "factor" });
  const number = element("input", { type: "number", min: "0", max: "1", step: "any", id: "factor-number" });
  const field = element("div", { class: "factor" }, labelled("Forgetting factor λ", slider), number);
  const memory = element("small");
  byId("factor-field").append(field, memory);
  const tell = () => {
    const samples = 1 / (1 - Number(number.value));
    memory.textContent = Number.isFinite(samples) ? `remembers about ${Number(samples.toPrecision(3))} samples` : "never forgets";
  };
  number.value = DEFAULT_FACTOR;
  slider.value = toSlider(DEFAULT_FACTOR);
  slider.addEventListener("input", () => ((number.value = fromSlider(Number(slider.value))), tell(), changed()));
  number.addEventListener("change", () => ((slider.value = toSlider(Number(number.value))), tell(), changed()));
  tell();
  return { show: (yes) => (byId("factor-field").hidden = !yes), value: () => Number(number.value) };
}

/** The control of a parameter; undefined where it is left at its default. */
function parameterForm({ name, about, kind, range, words, default: value }, changed) {
  const given = typeof value === "number" || typeof value === "string" ? String(value) : "";
  const control =
    kind === "word"
      ? select(words.map((word) => ({ value: word })), given)
      : element("input", { type: "text", placeholder: given, inputmode: kind === "rule" ? "text" : "decimal" });
  control.addEventListener("change", changed);
  const read = () => {
    const text = control.value.trim();
    if (text === "" || text === given) return undefined;
    return kind === "word" || kind === "rule" ? text : numbers(name, text);
  };
  return { name, field: labelled(name, control, `${about}; ${range}`), value: read };
}

/** A number, or a list of them with commas or blanks between. */
function numbers(name, text) {
  const found = text.split(/[\s,;]+/).filter(Boolean).map(Number);
  if (found.some(Number.isNaN)) throw new Error(`${name} = "${text}", allowed: a number, or a list of numbers`);
  return found.length === 1 ? found[0] : found;
}
