// The story of windup, live: an input that can be switched off, and three rules that go on.
import { Bank, RLS } from "forgetting";
import { byId, element, fromSlider, labelled, select, toSlider } from "./controls.js";
import { chart, colour, line } from "./charts.js";
import { rules } from "./rules.js";

const KEPT = 600; // samples on the charts
const EACH = 3; // samples a frame
const FACTOR = 0.95;
const NOISE = 0.1;
const LEAK = 1e-3; // what is left of the input when it is off
const THRESHOLD = 0.1; // of rules that have one: what carries less than the noise tells nothing
const COLOURS = ["vermillion", "blue", "orange"];

/** Normal random numbers from a seed: the story is the same each time. */
export function normal(seed) {
  let state = seed >>> 0;
  const uniform = () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}

/** y(k) = a u(k) + 1·u(k−1) + noise, where a moves slowly; u is random, or all but silent. */
export class Plant {
  constructor(seed) {
    this.random = normal(seed);
    this.k = 0;
    this.before = 0;
  }

  next(isOn) {
    const u = this.random() * (isOn ? 1 : LEAK);
    const a = 2 + 0.5 * Math.sin(this.k / 150);
    const phi = [u, this.before];
    const y = a * u + this.before + NOISE * this.random();
    this.before = u;
    this.k += 1;
    return { k: this.k, phi, y, a, u };
  }
}

/** The rule of this name with this factor, and with the threshold where it has one. */
function ruleOf(name, factor) {
  const entry = rules().find((each) => each.name === name);
  if (!entry?.forgetting_factor) return { name };
  const threshold = entry.parameters.some((each) => each.name === "threshold") ? { threshold: THRESHOLD } : {};
  return { name, forgetting_factor: factor, ...threshold };
}

/** One rule along the plant. */
class Runner {
  constructor(name, factor) {
    const rule = ruleOf(name, factor);
    this.name = name === "auto" ? "the bank" : name + (rule.threshold ? `, threshold ${rule.threshold}` : "");
    this.estimator = name === "auto" ? new Bank(2) : new RLS(2, { rule, monitor: true });
    this.estimates = [];
    this.variances = [];
    this.fault = "";
  }

  take(phi, y) {
    if (!this.fault) {
      try {
        this.estimator.update(phi, y);
      } catch (error) {
        this.fault = error.message; // P has left the range of numbers: the rule has ended
      }
    }
    const P = this.estimator.covariance;
    push(this.estimates, this.fault ? null : this.estimator.theta[0]);
    push(this.variances, this.fault ? null : Math.max(P[0], P[3]));
  }

  tell() {
    const [estimate, variance] = [this.estimates, this.variances].map((each) => each[each.length - 1]);
    return { name: this.name, estimate, variance, fault: this.fault };
  }

  free() {
    this.estimator.free();
  }
}

function push(values, value) {
  values.push(value);
  if (values.length > KEPT) values.shift();
}

/** The story and its controls. */
export class Story {
  constructor(asked) {
    const words = [{ value: "auto", words: "the bank" }, ...rules().map((entry) => ({ value: entry.name }))];
    const first = rules().some((entry) => entry.name === asked) ? asked : "subspace";
    const second = first === "random_walk" ? "subspace" : "random_walk";
    this.others = [select(words, first), select(words, second)];
    this.factor = element("input", { type: "range", min: "200", max: "800", value: String(toSlider(FACTOR)), id: "story-factor" });
    this.isOn = true;
    this.isRunning = false;
    this.build();
    this.start();
  }

  build() {
    const told = element("output", {}, String(FACTOR));
    byId("story-controls").append(
      labelled("Beside exponential", this.others[0]),
      labelled("and", this.others[1]),
      labelled("Forgetting factor λ", this.factor),
      told,
    );
    this.others.forEach((each) => each.addEventListener("change", () => this.start()));
    this.factor.addEventListener("input", () => ((told.textContent = this.factorNow()), this.start()));
    byId("switch").addEventListener("click", () => this.turn(!this.isOn));
    byId("run").addEventListener("click", () => this.go(!this.isRunning));
    byId("again").addEventListener("click", () => this.start());
  }

  factorNow() {
    return fromSlider(Number(this.factor.value));
  }

  start() {
    this.runners?.forEach((each) => each.free());
    this.plant = new Plant(1);
    const factor = this.factorNow();
    const names = ["exponential", ...this.others.map((each) => each.value)];
    this.runners = names.map((name) => new Runner(name, factor));
    Object.assign(this, { rows: [], truth: [], silent: [] });
    this.turn(true);
    this.advance(150);
    this.charts();
    this.draw();
  }

  turn(on) {
    this.isOn = on;
    byId("switch").textContent = on ? "Switch the input off" : "Switch the input on";
    byId("switch").setAttribute("aria-pressed", String(!on));
  }

  go(running) {
    this.isRunning = running;
    byId("run").textContent = running ? "Pause" : "Run";
    if (running) requestAnimationFrame(() => this.frame());
  }

  frame() {
    if (!this.isRunning) return;
    this.advance(EACH);
    this.draw();
    requestAnimationFrame(() => this.frame());
  }

  advance(samples) {
    for (let i = 0; i < samples; i++) {
      const { k, phi, y, a } = this.plant.next(this.isOn);
      push(this.rows, k);
      push(this.truth, a);
      push(this.silent, this.isOn ? 0 : 1);
      this.runners.forEach((each) => each.take(phi, y));
    }
  }

  charts() {
    const marks = [() => this.stretches()];
    const lines = this.runners.map((_, i) => line(COLOURS[i]));
    const truth = line("ink", 1, { dash: [5, 4] });
    const near = () => [-1, 5];
    this.estimates = chart(byId("story-estimates"), [[], [], ...lines.map(() => [])], [truth, ...lines], { range: near, marks });
    this.variances = chart(byId("story-variances"), [[], ...lines.map(() => [])], lines, { log: true, marks });
  }

  stretches() {
    const found = [];
    this.silent.forEach((off, place) => {
      if (!off) return;
      if (place && this.silent[place - 1]) found[found.length - 1][1] = this.rows[place];
      else found.push([this.rows[place], this.rows[place]]);
    });
    return found;
  }

  draw() {
    this.estimates.setData([this.rows, this.truth, ...this.runners.map((each) => each.estimates)]);
    this.variances.setData([this.rows, ...this.runners.map((each) => each.variances)]);
    const items = this.runners.map((each, i) => {
      const { name, estimate, variance, fault } = each.tell();
      const words = fault ? `ended: ${fault}` : `a = ${estimate.toFixed(2)}, variance in P ${variance.toPrecision(2)}`;
      const spot = element("span", { class: "spot" });
      spot.style.background = colour(COLOURS[i]);
      return element("li", {}, spot, `${name}: ${words}`);
    });
    byId("story-legend").replaceChildren(...items);
    byId("story-now").textContent = `sample ${this.plant.k}; a is ${this.truth[this.truth.length - 1].toFixed(2)}`;
  }
}
