"""The JavaScript module: its README, its types, states that go from language to language."""

from __future__ import annotations

import base64
import functools
import json
import re
import subprocess
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import numpy as np
import pytest

import forgetting as fg

from .conftest import MODULE, ROOT

START = """
import {{ readFileSync }} from "node:fs";
import init, * as fg from "{module}/forgetting.js";
await init({{ module_or_path: readFileSync("{module}/forgetting_bg.wasm") }});
const refusal = (call) => {{
  try {{ call(); }} catch (error) {{ return [error.name, error.message]; }}
}};
const list = (numbers) => Array.from(numbers);
"""


def node(script: str, folder: Any) -> Any:
    """What a script for Node tells as JSON: the value of its last line."""
    path = folder / "script.mjs"
    path.write_text(START.format(module=MODULE) + script, encoding="utf-8")
    done = subprocess.run(["node", path], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_readme_runs(tmp_path):
    readme = (ROOT / "crates/forgetting-wasm/README.md").read_text(encoding="utf-8")
    example = re.findall(r"```js\n(.*?)```", readme, re.DOTALL)[0]
    for line in ('import init, { Bank, RLS } from "forgetting";', "await init();"):
        assert line in example
        example = example.replace(line, "")
    script = f"""
    const {{ Bank, RLS }} = fg;
    const say = console.log;
    console.log = () => {{}};
    {example}
    say(JSON.stringify([list(bank.theta), error, windup]));
    """
    theta, error, windup = node(script, tmp_path)
    np.testing.assert_allclose(theta, [3.0, 0.5], atol=1e-3)
    assert error == 4.0 and windup is False


def test_the_registries_are_those_of_python(tmp_path):
    axes = node("console.log(JSON.stringify(fg.axes()))", tmp_path)
    for axis in axes:
        expected = getattr(fg, axis["plural"])()
        assert [entry["name"] for entry in axis["entries"]] == [each["name"] for each in expected]
        for entry, known in zip(axis["entries"], expected, strict=True):
            assert entry["summary"] == known["summary"]
            for mine, theirs in zip(entry["parameters"], known["parameters"], strict=True):
                assert mine["name"] == theirs["name"] and mine["range"] == theirs["range"]
                assert mine["required"] == theirs["required"]


@pytest.mark.parametrize("kind", ["RLS", "Bank"])
def test_a_state_goes_from_python_to_javascript_and_back(kind, tmp_path):
    random = np.random.default_rng(1)
    phi, y = random.normal(size=(40, 3)), random.normal(size=40)
    estimator = (
        fg.Bank(3)
        if kind == "Bank"
        else fg.RLS(3, rule=fg.rule("efra", forgetting_factor=0.97), monitor=True)
    )
    estimator.run(phi, y)
    state = base64.b64encode(estimator.to_bytes()).decode()
    script = f"""
    const estimator = fg.{kind}.from_bytes(Buffer.from("{state}", "base64"));
    const state = Buffer.from(estimator.to_bytes()).toString("base64");
    console.log(JSON.stringify([list(estimator.theta), list(estimator.covariance), state]));
    """
    theta, covariance, back = node(script, tmp_path)
    assert theta == estimator.theta.tolist()
    np.testing.assert_allclose(covariance, estimator.covariance.ravel(), rtol=1e-13)
    assert back == state


REFUSED = {
    "new fg.RLS(0)": ("InvalidInput", "parameters = 0"),
    "new fg.RLS(2.5)": ("InvalidInput", "parameters = 2.5, allowed: a whole number"),
    "new fg.RLS()": ("InvalidInput", "parameters = NaN"),
    "new fg.RLS(2, { rule: 'nonsense' })": ("InvalidInput", "nonsense"),
    "new fg.RLS(2, { rules: 'efra' })": ("InvalidInput", "settings has no rules; it has: rule"),
    "new fg.RLS(2, { rule: { name: 'efra', speed: 1 } })": ("InvalidInput", "speed"),
    "new fg.RLS(2, { rule: { name: 'none', forgetting_factor: 0.9 } })": (
        "InvalidInput",
        "uses none",
    ),
    "new fg.RLS(2, { rule: 'exponential', forgetting_factor: 2 })": (
        "InvalidInput",
        "forgetting_factor = 2",
    ),
    "new fg.RLS(2, { dtype: 'float32' })": ("InvalidInput", "float64"),
    "new fg.RLS(2, 7)": ("InvalidInput", "settings = 7, allowed: an object"),
    "new fg.RLS(2, { rule: 'function' })": ("InvalidInput", "function"),
    "new fg.Bank(2, { members: 'efra' })": ("InvalidInput", "members"),
    "estimator.update([1, 2, 3], 1)": ("InvalidInput", "phi has shape (3,)"),
    "estimator.update(['a', 2], 1)": ("InvalidInput", "phi"),
    "estimator.update([1, NaN], 1)": ("InvalidInput", "phi"),
    "estimator.update([1, 2])": ("InvalidInput", "y has undefined"),
    "estimator.update([1, 2], 1, { elapsed: -1 })": ("InvalidInput", "elapsed"),
    "estimator.update([1e200, 2], 1)": ("NumericalRange", ""),
    "estimator.run([1, 2, 3], [1, 2])": ("InvalidInput", ""),
    "estimator.run([1, 2, 3, 4], [1, NaN])": ("InvalidInput", "sample 1"),
    "estimator.run([1, 2], [1], { outputs: ['tetha'] })": ("InvalidInput", "tetha"),
    "estimator.update(around(), 1)": ("InvalidInput", "phi has an array"),
    "new fg.RLS(2, { rule: holding() })": ("InvalidInput", "rule has an object"),
    "new fg.RLS(32768)": ("MemoryError", "memory"),
    "new fg.Bank(2, { members: [null] })": ("InvalidInput", "members"),
    "new fg.Bank(2, { members: [] })": ("InvalidInput", "members = 0"),
    "fg.RLS.from_bytes(new Uint8Array([1, 2, 3]))": ("InvalidInput", ""),
}


def test_what_is_refused_changes_nothing_and_says_what_is_allowed(tmp_path):
    calls = ",\n".join(f"() => {call}" for call in REFUSED)
    script = f"""
    const estimator = new fg.RLS(2);
    estimator.update([1, 2], 3);
    const before = list(estimator.to_bytes());
    const around = () => {{ const ring = []; ring.push(ring); return ring; }};
    const holding = () => {{
      const rule = {{ name: "covariance_resetting" }};
      rule.rule = rule;
      return rule;
    }};
    const found = [{calls}].map(refusal);
    const same = JSON.stringify(list(estimator.to_bytes())) === JSON.stringify(before);
    console.log(JSON.stringify([found, same]));
    """
    found, same = node(script, tmp_path)
    for (call, (name, words)), refused in zip(REFUSED.items(), found, strict=True):
        assert refused is not None, call
        assert refused[0] == name and words in refused[1], (call, refused)
    assert same


def test_samples_one_by_one_are_those_of_a_record(tmp_path):
    script = """
    const [phi, y] = [[], []];
    for (let k = 0; k < 50; k++) { phi.push([1, Math.sin(k), k % 3]); y.push(Math.cos(k)); }
    const inner = { name: "exponential", forgetting_factor: 0.9 };
    const rule = { name: "covariance_resetting", rule: inner };
    const [one, many] = [new fg.RLS(3, { rule }), new fg.RLS(3, { rule })];
    phi.forEach((row, k) => one.update(Float64Array.from(row), y[k]));
    const run = many.run(phi, y, { outputs: ["theta", "skipped", "rank"] });
    const zeros = new fg.RLS(3, { targets: 2 }).theta;
    const same = one.predict([1, 0, 0]) === one.theta[0];
    const last = list(run.theta).slice(-3);
    const thetas = [list(one.theta), list(many.theta), last];
    const told = [...thetas, run.used, one.describe(), list(zeros), same];
    console.log(JSON.stringify(told));
    """
    one, many, last, used, description, zeros, same = node(script, tmp_path)
    assert one == many == last and used == 50 and same
    assert description["rule"]["rule"]["name"] == "exponential"
    assert description["rate"]["forgetting_factor"] == 0.9
    assert zeros == [0.0] * 6


def test_a_page_imports_it_as_it_is(browser):
    """`init()` without arguments finds the other file beside the module."""
    handler = functools.partial(Quiet, directory=MODULE)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        page = browser.new_page()
        page.goto(f"http://127.0.0.1:{server.server_port}/package.json")
        theta = page.evaluate(
            """async () => {
                const { default: init, RLS } = await import("/forgetting.js");
                await init();
                const estimator = new RLS(1);
                estimator.update(2, 4);
                return estimator.theta[0];
            }"""
        )
        page.close()
        server.shutdown()
    assert abs(theta - 2.0) < 1e-3


class Quiet(SimpleHTTPRequestHandler):
    """Serves files without a word."""

    def log_message(self, *_: object) -> None:
        """Nothing."""


TYPED = """
import init, { axes, Bank, RLS, type Run, type Settings } from "forgetting";
await init();
const settings: Settings = { rule: { name: "subspace", forgetting_factor: 0.98 }, monitor: true };
const estimator = new RLS(2, settings);
const { error, gate } = estimator.update([1, 2], 3, { elapsed: 2 });
const run: Run = estimator.run(new Float64Array(8), new Float64Array(4), { outputs: ["theta"] });
const theta: Float64Array | undefined = run.theta;
const status: string | undefined = estimator.health()?.status;
const names: string[] = axes().map((axis) => axis.name);
const memory: number = new Bank(3).memory;
console.log(error, gate, theta, status, names, memory);
"""


def test_the_types_fit(tmp_path):
    compiler = ROOT / "docs/playground/node_modules/.bin/tsc"
    (tmp_path / "node_modules").mkdir()
    (tmp_path / "node_modules/forgetting").symlink_to(MODULE)
    arguments = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--lib"]
    options = [*arguments, "es2022,dom,esnext.disposable"]
    for text, right in ((TYPED, True), (TYPED.replace('"theta"]', '"tetha"]'), False)):
        (tmp_path / "example.mts").write_text(text, encoding="utf-8")
        done = subprocess.run(
            [compiler, *options, "example.mts"], cwd=tmp_path, capture_output=True, text=True
        )
        assert (done.returncode == 0) is right, done.stdout


def test_the_package_is_ready_for_npm(tmp_path):
    done = subprocess.run(
        ["npm", "pack", "--json", "--dry-run", MODULE], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    (packed,) = json.loads(done.stdout)
    names = {file["path"] for file in packed["files"]}
    assert {"forgetting.js", "forgetting.d.ts", "forgetting_bg.wasm", "README.md"} <= names
    assert packed["size"] < 250_000
    assert packed["version"] == fg.__version__
