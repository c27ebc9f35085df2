// The choice of columns and of a model.
import { byId, element, labelled, select } from "./controls.js";

/** The form for a table; `changed` is called when something is chosen. */
export function modelForm(changed) {
  let table = { columns: [] };
  const output = element("select", { id: "output" });
  const inputs = element("div", { id: "inputs", class: "boxes" });
  const kind = select([{ value: "linear", words: "linear regression" }, { value: "arx", words: "ARX: with past values" }]);
  kind.id = "kind";
  const orders = Object.fromEntries(["na", "nb", "nk"].map((name) => [name, order(name, changed)]));
  const constant = element("input", { type: "checkbox", id: "constant", checked: true });
  const ordersField = element("div", { class: "orders" }, ...Object.values(orders).map((each) => each.field));
  const box = element("label", { class: "box" }, constant, "a constant");
  byId("model").append(labelled("Output y", output), element("span", { class: "title" }, "Inputs"), inputs);
  byId("model").append(labelled("Model", kind), ordersField, box);

  const usable = () => table.columns.filter((column) => column.values);
  const named = (name) => table.columns.find((column) => column.name === name);
  const boxes = () => [...inputs.querySelectorAll("input")];
  const showInputs = (chosen) => {
    const others = usable().filter((column) => column.name !== output.value);
    inputs.replaceChildren(...others.map((column) => inputBox(column, chosen.includes(column.name), changed)));
  };
  const chosenInputs = () => boxes().filter((each) => each.checked).map((each) => each.value);
  const showOrders = () => (ordersField.hidden = kind.value !== "arx");
  output.addEventListener("change", () => (showInputs(chosenInputs()), changed()));
  kind.addEventListener("change", () => (showOrders(), changed()));
  constant.addEventListener("change", changed);
  showOrders();

  return {
    show(given, wanted = {}) {
      table = given;
      output.replaceChildren(...usable().map((column) => element("option", { value: column.name }, title(column))));
      output.value = named(wanted.output) ? wanted.output : usable()[usable().length - 1].name;
      kind.value = wanted.kind || kind.value;
      for (const [name, value] of Object.entries(wanted.orders || {})) orders[name].control.value = value;
      constant.checked = wanted.constant ?? constant.checked;
      const rest = usable().map((column) => column.name).filter((name) => name !== output.value);
      showInputs(wanted.inputs || rest.slice(0, 1));
      showOrders();
    },
    chosen() {
      const whole = (name) => orders[name].value();
      const model = { output: named(output.value), inputs: chosenInputs().map(named), kind: kind.value };
      return { ...model, constant: constant.checked, na: whole("na"), nb: whole("nb"), nk: whole("nk") };
    },
  };
}

const title = (column) => (column.unit ? `${column.name} [${column.unit}]` : column.name);

function inputBox(column, checked, changed) {
  const control = element("input", { type: "checkbox", value: column.name, checked });
  control.addEventListener("change", changed);
  return element("label", { class: "box" }, control, title(column));
}

const MEANINGS = { na: "past outputs", nb: "values of each input", nk: "delay of the newest input" };
const DEFAULTS = { na: 1, nb: 2, nk: 0 };
const MOST = 50;

function order(name, changed) {
  const range = { min: "0", max: String(MOST), step: "1" };
  const control = element("input", { type: "number", value: String(DEFAULTS[name]), id: name, ...range });
  control.addEventListener("input", changed);
  const value = () => {
    const number = control.value === "" ? NaN : Number(control.value);
    if (Number.isInteger(number) && number >= 0 && number <= MOST) return number;
    throw new Error(`${name} = ${control.value || "nothing"}, allowed: whole numbers from 0 to ${MOST}`);
  };
  return { control, value, field: labelled(name, control, MEANINGS[name]) };
}
