"""What `forgetting fleet` refuses: options, files, states."""

from __future__ import annotations

import pytest
from fleet_rows import FILES, MODEL, part
from pyarrow import feather, parquet


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (("--model", "armax:na=1,nb=1,nc=1"), "allowed: fir, ar and arx"),
        (("--model", "arx:na=1", "--arx", "1,1,1"), "allowed: one of them"),
        (("--model", "arx:nz=1"), "is not an order"),
        (("--model", "ar:na=1"), "inputs go with nb"),
    ],
)
def test_a_model_that_a_fleet_cannot_have_is_refused(forgetting, data, said, words):
    done = forgetting("fleet", data, *MODEL, *said)
    assert done.code == 2 and words in done.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--by", "devices"), "part0.parquet has no column 'devices'; close are 'device'"),
        (("--output", "device"), "has two roles"),
        (("--output", "t"), "has two roles"),
        (("--input", "y"), "and not y"),
        (("--arx", "1,2"), "three whole numbers"),
        (("--tell", "gain"), "outputs = 'gain', allowed: prediction"),
        (("--batch-rows", "0"), "batch_rows = 0"),
        (("--streams", "s.csv"), "--streams writes .parquet"),
        (("--state", "no/such/f.arrow"), "there is no folder"),
        (("--half-life", "1h", "--forgetting-factor", "0.9"), "--half-life goes without"),
        (("--half-life", "soon"), "half_life"),
        (("--rule", "best"), "no rule 'best'"),
        (
            ("--rule", "auto", "--half-life", "1h"),
            "--half-life needs a rule with a forgetting factor",
        ),
        (("--rule", "auto", "--forgetting-factor", "0.9"), "the rule 'auto' has no parameters"),
    ],
)
def test_bad_use(forgetting, data, arguments, words):
    assert words in forgetting("fleet", data, *MODEL, *arguments).sentence()


def test_bad_files(forgetting, data, tmp_path):
    def refused(*arguments: object) -> str:
        return forgetting("fleet", *arguments, *MODEL).sentence()

    assert "there is no file" in refused(tmp_path / "nothing*.parquet")
    assert "write elsewhere" in refused(data, "--out", data)
    for option in ("--state", "--streams"):
        for path in (data / "part0.parquet", data / "new.parquet"):
            assert "is the record that is read" in refused(data, option, path)
        assert "is the record" in refused(data / "*.parquet", option, data / "part1.parquet")
    assert "are one file" in refused(data, "--state", "a.parquet", "--streams", "a.parquet")
    assert len(list(data.iterdir())) == FILES
    state = tmp_path / "f.arrow"
    forgetting("fleet", data / "part0.parquet", *MODEL, "--state", state)
    before = state.read_bytes()
    assert "of other columns or another rule" in refused(data, "--state", state, "--no-offset")
    assert "of other columns or another rule" in refused(data, "--state", state, "-r", "none")
    (data / "part1.parquet").write_bytes(b"PAR1 and nothing more")
    assert "part1.parquet" in refused(data, "--state", state, "--out", tmp_path / "out")
    assert state.read_bytes() == before
    parquet.write_table(part(7), data / "part0.parquet")
    assert "part0.parquet has changed since" in refused(data, "--state", state)
    state.write_text("something else")
    assert "is no state of a fleet" in refused(data, "--state", state)
    feather.write_feather(part(0), state)
    assert "is no state of a fleet" in refused(data, "--state", state)
