// The playground: a file or an example, a model, a rule; all of it computed in this page.
import init, { version } from "forgetting";
import wasm from "forgetting/forgetting_bg.wasm";
import battery from "../../../python/forgetting/demo/data/battery.csv";
import { byId } from "./controls.js";
import { plantTable } from "./examples.js";
import { identify } from "./identify.js";
import { modelForm } from "./model.js";
import { refuse, show } from "./results.js";
import { ruleForm } from "./rules.js";
import { samplesOf } from "./samples.js";
import { decode, read } from "./table.js";
import { judge } from "./verdict.js";
import { Story } from "./windup.js";

const page = { found: null, story: null, error: "", waiting: false };
window.playground = page; // for tests, and for the curious

let model, rule, waiting;

/** Computes soon; changes that follow each other at once are one. */
function changed() {
  clearTimeout(waiting);
  page.waiting = true;
  waiting = setTimeout(compute, 30);
}

function compute() {
  try {
    const chosen = model.chosen();
    const found = identify(samplesOf(chosen), rule.chosen());
    found.outputName = chosen.output.name;
    found.judgement = judge(found);
    Object.assign(page, { found, error: "", waiting: false });
    show(found, found.judgement);
  } catch (error) {
    Object.assign(page, { found: null, error: error.message, waiting: false });
    refuse(error);
  }
}

function open(table, name, wanted) {
  byId("file-name").textContent = `${name}: ${table.rows} rows`;
  const left = table.columns.filter((column) => column.fault);
  byId("left-out").textContent = left.map((column) => `${column.name} is left out: ${column.fault}`).join("; ");
  byId("form").hidden = false;
  model.show(table, wanted);
  compute();
}

async function openFile(file) {
  clearTimeout(waiting); // what was asked of the table before is not shown beside the new one
  page.waiting = true;
  try {
    open(read(decode(new Uint8Array(await file.arrayBuffer()))), file.name);
  } catch (error) {
    Object.assign(page, { found: null, error: `${file.name}: ${error.message}`, waiting: false });
    refuse(new Error(page.error));
  }
}

const EXAMPLES = {
  battery: () =>
    open(read(battery), "battery cell under load, whose resistance (minus the parameter of I(k)) grows", {
      output: "V",
      inputs: ["I"],
      kind: "arx",
      constant: true,
      orders: { na: 1, nb: 2, nk: 0 },
    }),
  plant: () =>
    open(plantTable(), "simulated plant whose gain falls", {
      output: "y",
      inputs: ["u"],
      kind: "arx",
      constant: false,
      orders: { na: 1, nb: 1, nk: 1 },
    }),
};

function listen() {
  const drop = byId("drop");
  byId("file").addEventListener("change", (event) => event.target.files[0] && openFile(event.target.files[0]));
  for (const name of ["dragover", "dragenter"]) {
    drop.addEventListener(name, (event) => (event.preventDefault(), drop.classList.add("over")));
  }
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    if (event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]);
  });
  for (const name of Object.keys(EXAMPLES)) byId(name).addEventListener("click", EXAMPLES[name]);
}

/** What the address asks for after its #: rule=subspace, example=plant, only=windup; the rule is in the story, too. */
function asked() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  document.body.classList.toggle("only-windup", wanted.get("only") === "windup");
  document.body.classList.toggle("framed", window.self !== window.top);
  if (wanted.get("rule")) rule.choose(wanted.get("rule"));
  (EXAMPLES[wanted.get("example")] || EXAMPLES.battery)();
  page.story = new Story(wanted.get("rule"));
}

async function begin() {
  await init({ module_or_path: wasm });
  byId("version").textContent = version();
  model = modelForm(changed);
  rule = ruleForm(changed);
  listen();
  asked();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => location.reload());
  document.body.dataset.ready = "yes";
}

begin().catch(refuse);
