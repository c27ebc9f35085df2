"""Any name of a column in any output."""

from __future__ import annotations

import json
import warnings

import numpy as np
import pandas as pd

from forgetting.cli import main
from forgetting.plot import save_overview
from forgetting.record import identify, read
from forgetting.report import save

NAMES = [
    "cost $ in US$", "$x_1$", r"\frac{a}{b}$^$", "_hidden", "a\nb", "温度", "a\x1b[31mb", "<b>&\"'",
    "{{ 7 * 7 }}", "[red]x[/red]", "x,y;z", "%s", "a`b", "\u202eabc", "😀", " ",
]  # fmt: skip


def test_names_in_every_output(tmp_path, capsys):
    rng = np.random.default_rng(0)
    table = {"time": np.arange(80.0)} | {name: rng.normal(size=80) for name in NAMES}
    frame = pd.DataFrame(table | {"cost $ out$": rng.normal(size=80)})
    *inputs, output = read(frame).frame.columns[1:]
    found = identify(frame, output=output, input=inputs, arx=(1, 1, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        save(found, tmp_path / "r.html")
        save_overview(found, tmp_path / "p.pdf")
    html = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert '<b>&"' not in html
    for suffix in ("csv", "parquet"):
        found.save_estimates(tmp_path / f"e.{suffix}")
        columns = set(read(tmp_path / f"e.{suffix}").frame.columns)
        assert {f"estimate:{name}(k)" for name in inputs} <= columns
    frame.to_parquet(tmp_path / "record.parquet")
    command = ["identify", str(tmp_path / "record.parquet"), "-y", output, "--arx", "1,1,0"]
    command += [word for name in inputs for word in ("-u", name)]
    assert main(command) == 0
    assert "\x1b[31m" not in capsys.readouterr().out
    assert main([*command, "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert {f"{name}(k)" for name in inputs} <= {row["parameter"] for row in printed["parameters"]}


def test_a_clock_named_by_dollars(tmp_path):
    frame = pd.DataFrame({"time $a$ b$": np.arange(30.0), "x": 1.0, "y": np.arange(30.0)})
    found = identify(frame, formula="y ~ x", time="time $a$ b$")
    save(found, tmp_path / "r.html")
    assert "time $a$ b$" in (tmp_path / "r.html").read_text(encoding="utf-8")
