"""Files are written whole or not at all, and never over the record."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from forgetting.files import check_outputs, whole
from forgetting.plot import save_overview
from forgetting.record import RecordError, identify
from forgetting.report import save


@pytest.fixture
def record(tmp_path: Path) -> Path:
    rng = np.random.default_rng(0)
    frame = pd.DataFrame({"a": rng.normal(size=60)})
    path = tmp_path / "record.csv"
    frame.assign(y=2 * frame["a"]).to_csv(path, index=False)
    return path


def only(folder: Path, *names: str) -> bool:
    """Whether a folder holds these files and no temporary one."""
    return sorted(path.name for path in folder.iterdir()) == sorted(names)


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_what_interrupts_the_writing_leaves_the_old_file(tmp_path, error):
    target = tmp_path / "a.csv"
    target.write_text("old")
    with pytest.raises(type(error)) as caught, whole(target) as made:
        made.write_text("half")
        raise error
    if isinstance(error, OSError):
        assert caught.value.filename == str(target)
    assert target.read_text() == "old" and only(tmp_path, "a.csv")


def test_a_full_disk_leaves_the_old_estimates(record, tmp_path, monkeypatch):
    found = identify(record, formula="y ~ a")
    found.save_estimates(tmp_path / "e.csv")
    before = (tmp_path / "e.csv").read_bytes()

    def full(self, path, **options):
        Path(path).write_text("half of it")
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(pd.DataFrame, "to_csv", full)
    with pytest.raises(OSError) as caught:
        found.save_estimates(tmp_path / "e.csv")
    assert caught.value.filename == str(tmp_path / "e.csv")
    assert (tmp_path / "e.csv").read_bytes() == before
    assert only(tmp_path, "record.csv", "e.csv")


def test_a_killed_process_leaves_the_old_file(tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old")
    code = (
        "import os, signal, sys\n"
        "from forgetting.files import whole\n"
        "with whole(sys.argv[1]) as made:\n"
        "    made.write_text('half')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", code, str(target)], timeout=60)
    assert done.returncode == -signal.SIGKILL and target.read_text() == "old"


def test_a_link_is_followed_and_the_mode_is_kept(tmp_path):
    real = tmp_path / "real.txt"
    real.write_text("old")
    real.chmod(0o640)
    (tmp_path / "link.txt").symlink_to(real)
    with whole(tmp_path / "link.txt") as made:
        made.write_text("new")
    assert (tmp_path / "link.txt").is_symlink() and real.read_text() == "new"
    assert real.stat().st_mode & 0o777 == 0o640


def test_what_is_no_file_is_written_directly():
    with whole(os.devnull) as made:
        made.write_text("gone")
    assert not Path(os.devnull).is_file()


def names_of(record: Path, how: str) -> Path:
    """Another name of the record."""
    other = record.with_name(f"{how}.csv")
    if how == "same":
        return record
    if how == "dots":
        return record.parent / "." / ".." / record.parent.name / record.name
    if how == "link":
        other.symlink_to(record)
    else:
        other.hardlink_to(record)
    return other


@pytest.mark.parametrize("how", ["same", "dots", "link", "hard"])
def test_the_record_is_never_an_output(record, how):
    before = record.read_bytes()
    found = identify(record, formula="y ~ a")
    other = names_of(record, how)
    with pytest.raises(RecordError, match=r"is the record that is read; name another file"):
        found.save_estimates(other)
    assert record.read_bytes() == before


def test_reports_and_pictures_refuse_the_record(tmp_path):
    path = tmp_path / "odd.html"
    path.write_text("a,y\n1,2\n2,4\n3,6\n")
    found = identify(path, formula="y ~ a")
    with pytest.raises(RecordError, match="is the record"):
        save(found, path)
    picture = tmp_path / "odd.png"
    picture.hardlink_to(path)
    with pytest.raises(RecordError, match="is the record"):
        save_overview(found, picture)
    assert path.read_text().startswith("a,y")


def test_a_folder_that_is_the_record_gets_no_part_of_it(tmp_path):
    folder = tmp_path / "parts"
    folder.mkdir()
    pd.DataFrame({"a": [1.0, 2, 3], "y": [2.0, 4, 6]}).to_parquet(folder / "0.parquet")
    found = identify(folder, formula="y ~ a")
    with pytest.raises(RecordError, match="is the record"):
        found.save_estimates(folder / "1.parquet")
    assert only(folder, "0.parquet")


def test_two_outputs_are_two_files(tmp_path):
    one = tmp_path / "a.html"
    one.write_text("")
    (tmp_path / "b.html").hardlink_to(one)
    with pytest.raises(RecordError, match="--plot and --report are one file"):
        check_outputs({"--report": one, "--plot": tmp_path / "b.html"})
    with pytest.raises(RecordError, match="--plot and --report are one file"):
        check_outputs({"--report": tmp_path / "new", "--plot": tmp_path / "." / "new"})
    with pytest.raises(RecordError, match="there is no folder"):
        check_outputs({"--report": tmp_path / "none" / "a.html"})
    check_outputs({"--report": one, "--plot": None})
