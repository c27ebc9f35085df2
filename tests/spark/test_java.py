"""What is said where there is no Java runtime, or an old one."""

from __future__ import annotations

import pytest
from java import main


def test_none(tmp_path, monkeypatch):
    monkeypatch.setenv("JAVA_HOME", str(tmp_path))
    assert str(main()).endswith("there is none on PATH or in JAVA_HOME")


@pytest.mark.parametrize(("told", "fits"), [("1.8.0_402", False), ("11.0.2", False), ("21", True)])
def test_versions(told, fits, tmp_path, monkeypatch, capsys):
    program = tmp_path / "bin" / "java"
    program.parent.mkdir()
    program.write_text(f"#!/bin/sh\necho 'openjdk version \"{told}\" 2024-01-16' >&2\n")
    program.chmod(0o755)
    monkeypatch.setenv("JAVA_HOME", str(tmp_path))
    assert (main() is None) == fits
    assert (f"Java {told}" in capsys.readouterr().out) == fits
