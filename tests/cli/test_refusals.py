"""Everything a user can get wrong ends with exit code 2 and one sentence."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

MODEL = ("--formula", "V ~ I")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "say the model: a formula, or output columns"),
        (("--formula", "V ~ Q"), "no column 'Q'; its columns are 'time_s', 'I', 'V'"),
        (("--formula", "V ~ ("), "cannot be read"),
        (("--formula", "V"), "must read: output ~ regressors"),
        (("--output", "volt", "--arx", "1,0,0"), "no column 'volt'; its columns are"),
        (("--output", "V", "--input", "I", "--arx", "1,2"), "three whole numbers; got 2"),
        (("--output", "V", "--arx", "a,b,c"), "three whole numbers na,nb,nk such as 1,2,0"),
        ((*MODEL, "--output", "V"), "not both"),
        ((*MODEL, "--time", "clock"), "no column 'clock'"),
        ((*MODEL, "--rule", "exponental"), "no rule 'exponental'; close are 'exponential'"),
        ((*MODEL, "--forgetting-factor", "0"), "forgetting_factor"),
        ((*MODEL, "--forgetting-factor", "1.5"), "forgetting_factor"),
        ((*MODEL, "--forgetting-factor", "nan"), "forgetting_factor"),
        ((*MODEL, "--forgetting-factor", "fast"), "--forgetting-factor"),
        ((*MODEL, "--threshold", "-1"), "threshold"),
        ((*MODEL, "--rule", "none", "--forgetting-factor", "0.9"), "no parameter 'forgetting_f"),
        ((*MODEL, "--set", "speed=3"), "has no parameter 'speed'; it has forgetting_factor"),
        ((*MODEL, "--set", "threshold"), "--set takes name=value"),
        ((*MODEL, "--set", "threshold=1", "--threshold", "2"), "threshold is given twice"),
        ((*MODEL, "--set", "threshold=wide"), "threshold"),
        ((*MODEL, "--initial-covariance", "-1"), "initial_covariance"),
        ((*MODEL, "--initial-covariance", "much"), "--initial-covariance takes auto, a number"),
        ((*MODEL, "--initial-covariance", "1,2,3"), "initial_covariance"),
        ((*MODEL, "--bounds", "R=0:"), "no parameter 'R'; the parameters are 'Intercept', 'I'"),
        ((*MODEL, "--bounds", "I=1"), "--bounds takes names and values as in R0=0:,a=-1:1"),
        ((*MODEL, "--bounds", "I=1:0"), "the bounds of 'I' are 1 and 0"),
        ((*MODEL, "--bounds", "I=0:,I=:1"), "--bounds names 'I' twice"),
        ((*MODEL, "--fixed", ""), "--fixed takes names and values as in b=2.5"),
        ((*MODEL, "--fixed", "I=1e999"), "the fixed value of 'I' is inf"),
        ((*MODEL, "--prior", "I=1+-0"), "the prior of 'I' is 0.0; allowed: a finite number above"),
        ((*MODEL, "--prior", "I=1+-1", "--noise", "nan"), "the noise is nan"),
        ((*MODEL, "--level", "95"), "level = 95.0, allowed: between 0 and 1"),
        ((*MODEL, "--dtype", "float16"), "--dtype is 'float16'"),
        ((*MODEL, "--report", "o.txt"), "--report writes .html, .htm, but got 'o.txt'"),
        ((*MODEL, "--plot", "o.bmp"), "--plot writes .png"),
        ((*MODEL, "--estimates", "o.xlsx"), "--estimates writes .parquet, .csv"),
        ((*MODEL, "--report", "no/such/folder/o.html"), "there is no folder"),
        ((*MODEL, "--frobnicate"), "--frobnicate"),
        (("--output", "V", "--arx", f"{10**22},0,0"), f"na is {10**22}; it must be a whole number"),
        (("--output", "V", "--model", f"arma:na=1,nc={10**22}"), f"nc is {10**22}; it must be"),
        (
            (*MODEL, "--rule", "exponential", "--initial-covariance", "1e-300"),
            "initial_covariance[0] = 1e-300, allowed: positive, 3.1e-151 to 3.2e150",
        ),
        (
            (*MODEL, "--rule", "none", "--initial-covariance", "1e25", "--dtype", "float32"),
            "e24, allowed: positive, 2.2e-19 to 4.6e18",
        ),
        (
            (*MODEL, "--rule", "subspace", "--threshold", "1e300", "--dtype", "float32"),
            "threshold = 1e300, allowed: within the number type's range",
        ),
    ],
)
def test_bad_use(forgetting, battery, arguments, words):
    run = forgetting("identify", battery, *arguments)
    assert words in run.sentence()
    assert run.out == ""


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "there is no file"),
        ("", "is empty"),
        ("I,V\n", "has a header and no rows"),
        (
            "I,V\n1,2\nbad,4\n3,6\n",
            "column 'I' of record.csv must hold numbers, but row 2 is 'bad'",
        ),
        ("I,V\n1,2\n2,inf\n3,6\n", "column 'V' of record.csv is infinite in row 2"),
        ("I,V\n1,\n,4\n", "no complete sample"),
        ("I,V\n1e-310,1\n2e-310,4\n", "reaches 2e-310 in size, allowed: 0, or 1e-75 to 1e+75"),
        ("I,V\n1e140,1\n2e140,4\n", "reaches 2e+140 in size, allowed: 0, or 1e-75 to 1e+75"),
        ("I,V\n1,1e-170\n2,4e-170\n", "output 'V' of record.csv reaches 4e-170 in size, allowed"),
        ("I,V\n1,1e100\n2,4e140\n", "output 'V' of record.csv reaches 4e+140 in size, allowed"),
        ("I,V,I\n1,2,3\n", "2 columns named 'I'; say which: 'I (column 1)', 'I (column 3)'"),
    ],
)
def test_bad_data(forgetting, tmp_path, text, words):
    path = tmp_path / "record.csv"
    if text is not None:
        path.write_text(text)
    assert words in forgetting("identify", path, *MODEL).sentence()


def test_a_single_row_is_not_certified(forgetting, tmp_path):
    path = tmp_path / "record.csv"
    path.write_text("I,V\n1,2\n")
    run = forgetting("certify", path, *MODEL)
    assert "record.csv has 1 row; to certify an estimate takes at least 2" in run.sentence()


def test_numbers_beyond_all_range(forgetting, tmp_path):
    x = np.sin(np.arange(100.0))
    frame = pd.DataFrame({"x": x, "y": 2 * x})
    frame.loc[50, "y"] = 1e200
    frame.to_csv(tmp_path / "huge.csv", index=False)
    run = forgetting("identify", tmp_path / "huge.csv", "-f", "y ~ 0 + x", "-r", "exponential")
    assert "row 51" in run.sentence() and "numerical range" in run.sentence()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("identify",), "Missing argument"),
        (("nonsense",), "nonsense"),
        (("--nonsense",), "--nonsense"),
        (("rules", "subspaces"), "no rule 'subspaces'; close are 'subspace'"),
        (("demo", "lunar"), "no demo 'lunar'; choose battery, solar, cycling or all"),
    ],
)
def test_bad_commands(forgetting, arguments, words):
    assert words in forgetting(*arguments).sentence()


def test_output_that_cannot_be_written(forgetting, battery, tmp_path):
    (tmp_path / "o.csv").mkdir()
    run = forgetting("identify", battery, *MODEL, "--estimates", tmp_path / "o.csv")
    assert "o.csv" in run.err and run.code == 2 and run.err.count("\n") == 1
