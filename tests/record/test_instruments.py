"""Exports of instruments and services, each with its own habits; written here, line by line."""

from __future__ import annotations

import numpy as np
import pytest

from forgetting.record import identify, read


@pytest.fixture
def export(tmp_path):
    """Write an export and read it."""

    def made(text: str, encoding: str = "utf-8", **options):
        (tmp_path / "export").write_bytes(text.encode(encoding))
        return read(tmp_path / "export", **options)

    return made


def right(record, output, regressor, offset, slope):
    """The record holds output = offset + slope · regressor."""
    formula = f"`{output}` ~ `{regressor}`"
    found = identify(record, formula=formula, rule="none", initial_covariance=1e10)
    assert found.parameters["value"].tolist() == pytest.approx([offset, slope], rel=1e-6)
    return found


@pytest.mark.parametrize("decimal", [".", ","])
def test_potentiostat(export, decimal):
    rows = [f"2\t1\t{k / 2:.15E}\t{3 + k % 5 / 8:.7E}\t{k % 5:.7E}\t\r\n" for k in range(20)]
    head = "ASCII FILE\r\nNb header lines : 6   \r\n\r\nAcquired on : 01/02/2024\r\n\r\n"
    head += "mode\tox/red\ttime/s\tEwe/V\t<I>/µA\t\r\n"
    record = export(head + "".join(rows).replace(".", decimal), "cp1252")
    right(record, "Ewe/V", "<I>/µA", 3, 0.125)
    assert record.clock is not None and record.clock.steps.tolist() == [0.5] * 19


def test_potentiostat_with_a_first_column_of_nothing(export):
    rows = [f"\t{k}\t{k / 10}\t{1 + 2 * (k % 4)}\t{k % 4}\t.......\n" for k in range(20)]
    text = "EXPLAIN\nTAG\tCV\nAREA\tQUANT\t1.0\tArea\nCURVE\tTABLE\t20\n\tPt\tT\tVf\tIm\tOver\n"
    record = export(text + "\t#\ts\tV vs. Ref.\tA\tbits\n" + "".join(rows))
    right(record, "Vf", "Im", 1, 2)
    assert record.found.units["Vf"] == "V vs. Ref." and record.found.units["T"] == "s"
    assert record.clock is not None and record.clock.name == "T"


def test_oscilloscope_with_settings_beside_the_names(export):
    rows = [f"{k},{k % 3}.0,{2 + 3 * (k % 3)}.0,,\n" for k in range(20)]
    record = export(
        "X,CH1,CH2,Start,Increment\nSequence,Volt,Volt,-1.2e-03,1.0e-06\n" + "".join(rows)
    )
    right(record, "CH2", "CH1", 2, 3)


def test_temperature_logger(export):
    rows = [
        f"{k + 1},06/{12 + k // 24:02}/20 {k % 12 or 12:02}:00:00 {'AM' if k % 24 < 12 else 'PM'},"
        f"{k % 7},{5 + 2 * (k % 7)},\n"
        for k in range(48)
    ]
    head = (
        '"Plot Title: shed"\n"#","Date Time, GMT-05:00","Light, lx","Temp, °C (S/N: 1)","Ended"\n'
    )
    record = export("\ufeff" + head + "".join(rows))
    right(record, "Temp, °C (S/N: 1)", "Light, lx", 5, 2)
    assert record.clock is not None and record.clock.steps.tolist() == [3600.0] * 47


def test_racing_log(export):
    rows = [f'"{k / 20:.3f}","{k}","{1 + 2 * (k % 6)}","{k % 6}"\n' for k in range(30)]
    head = '"Format","CSV",,,"Book",""\n"Rate","20.000","Hz",,"Duration","7.1","s"\n\n\n'
    names = '"Time","Distance","Speed","Throttle"\n"s","m","km/h","%"\n\n'
    record = export(head + names + "".join(rows))
    right(record, "Speed", "Throttle", 1, 2)
    assert record.found.units == {"Time": "s", "Distance": "m", "Speed": "km/h", "Throttle": "%"}


def test_weather_service(export):
    rows = [
        f"         44;{2024010100 + k};    3;{k % 5};{-999 if k == 7 else 2 + 3 * (k % 5)};eor\n"
        for k in range(24)
    ]
    record = export("STATION;MESS_DATUM;QN;RF;TT;eor\n" + "".join(rows), missing=-999)
    assert right(record, "TT", "RF", 2, 3).used == 23
    assert record.clock is not None and record.clock.steps.tolist() == [3600.0] * 23


def test_factors_by_month_above_factors_by_year(export):
    rows = [f"{202301 + k},{k % 5 * 2 + 1:7.2f},{k % 5:7.2f}\n" for k in range(12)]
    below = "\n Annual: January-December \n,r,m\n  2023,   1.00,   9.00\n\nCopyright 2024\n"
    record = export("Made from a data base\n\n,r,m\n" + "".join(rows) + below)
    assert right(record, "r", "m", 1, 2).used == 12
    assert record.clock is not None and not record.clock.is_gap.any()
    assert any("another table below" in note for note in record.found.skipped)


def test_files_put_behind_one_another(export):
    text = "t;u;y;s\n0;1,0;3;a\n1;2,0;5;b\nt;u;y;s\n0;4,0;?;c\n1;3,5;8,0;d\n"
    record = export(text)
    assert right(record, "y", "u", 1, 2).used == 3
    assert "1 line with the names again" in record.found.skipped
    assert record.clock is not None and record.clock.is_gap.tolist() == [False, True, False]


def test_thousands_among_words(export):
    text = (
        "Zeitstempel;Wert;u;Status\n01.01.2024 00:00;1.001,00;500;ok\n01.01.2024 00:15;21,0;10;ok\n"
    )
    record = export(text + "01.01.2024 00:30;---;7;gestört\n", "cp1252")
    right(record, "Wert", "u", 1, 2)


def test_stretches_of_time(export):
    text = '"Time (CET/CEST)","Load [MW]"\n'
    text += "".join(
        f'"01.01.2024 0{k}:00 - 01.01.2024 0{k + 1}:00","{1000 + k}"\n' for k in range(8)
    )
    clock = export(text).clock
    assert clock is not None and clock.steps.tolist() == [3600.0] * 7


def test_battery_cycler(export):
    rows = [
        f"{k},{k / 2},01/02/2024 10:00:{k // 2:02},{k % 10 / 2:.4f},{k % 3},{3 + k % 3 / 4}\n"
        for k in range(40)
    ]
    names = "Data_Point,Test_Time(s),Date_Time,Step_Time(s),Current(A),Voltage(V)\n"
    record = export(names + "".join(rows))
    right(record, "Voltage(V)", "Current(A)", 3, 0.25)
    assert record.clock is not None and record.clock.name == "Test_Time(s)"
    np.testing.assert_allclose(record.clock.steps, 0.5)


def test_days_hours_and_minutes(export):
    rows = [
        f"{k + 1}\t   {k // 24}d {k % 24:02}:00:10.00\t{k % 3}\t{3 + k % 3}\n" for k in range(30)
    ]
    record = export(
        "Today's Date  01/02/2024  Filename:  x\nRec#\tTestTime\tA\tV\n" + "".join(rows)
    )
    right(record, "V", "A", 3, 1)
    assert record.clock is not None and record.clock.steps.tolist() == [3600.0] * 29
