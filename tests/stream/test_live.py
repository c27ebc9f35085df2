"""`--live`: one page of this machine, read-only, decimated, and drawn by a browser."""

from __future__ import annotations

import http.client
import json
import re
import shutil
import subprocess
import time
from collections.abc import Iterator
from html.parser import HTMLParser

import pytest

from forgetting.stream import Settings, Stream
from forgetting.stream.live import Events, Server
from forgetting.stream.live import events as told
from forgetting.stream.live.server import FILES, MOST, NAMES

from .conftest import PLANT, arx, as_csv, command, plant

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


class Page:
    """A stream, its page, and a browser of a few lines."""

    def __init__(self, settings: Settings) -> None:
        self.stream = Stream(settings, standard_errors=True)
        self.server = Server(Events(self.stream), port=0)
        self.server.start()

    def feed(self, data: bytes) -> None:
        self.server.events.take(self.stream.feed(data))

    def ask(self, path: str, method: str = "GET", **headers: str) -> http.client.HTTPResponse:
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_port, timeout=20)
        connection.request(method, path, headers=headers)
        return connection.getresponse()

    def events(self, many: int) -> list[tuple[str, dict]]:
        """So many events from the beginning."""
        found = []
        with self.ask("/events") as answer:
            assert answer.status == 200
            kind = ""
            while len(found) < many:
                line = answer.readline().decode().strip()
                if line.startswith("event: "):
                    kind = line.removeprefix("event: ")
                if line.startswith("data: "):
                    found.append((kind, json.loads(line.removeprefix("data: "))))
        return found


@pytest.fixture
def page() -> Iterator[Page]:
    made = Page(arx())
    yield made
    made.server.stop()


def test_names_have_units_where_the_stream_names_them():
    stream = Stream(arx(), standard_errors=True)
    head, *body = as_csv(plant(60)).splitlines(keepends=True)
    stream.feed(b"".join([head, b"s,A,mV\n", *body]))
    told = Events(stream).beginning(0)
    assert told["parameters"] == ["y(k-1) [1]", "u(k-1) [mV/A]", "offset [mV]"]
    assert told["outputs"] == ["y [mV]"]


def test_files_of_the_page(page):
    for path, (_, kind) in FILES.items():
        with page.ask(path) as answer:
            assert (answer.status, answer.headers["Content-Type"]) == (200, kind)
            assert len(answer.read()) == int(answer.headers["Content-Length"])
            assert "default-src 'self'" in answer.headers["Content-Security-Policy"]
            assert not [name for name in answer.headers if name.startswith("Access-Control")]


def test_the_page_needs_no_network(page):
    """Whatever it names is served here."""

    class Names(HTMLParser):
        found: list[str] = []  # noqa: RUF012

        def handle_starttag(self, tag, attributes):
            self.found += [value for name, value in attributes if name in ("src", "href")]

    names = Names()
    names.feed(page.ask("/").read().decode())
    local = [name for name in names.found if not name.startswith("data:")]
    assert {f"/{name}" for name in local} == set(FILES) - {"/"}
    for path in ("/page.css", "/page.js"):
        assert not re.search(r"https?://", page.ask(path).read().decode())


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS"])
def test_it_can_only_be_read(page, method):
    assert page.ask("/", method).status in (405, 501)


def test_other_paths(page):
    for path in ("/nothing", "/../server.py", "/page.css/..", "/uplot/LICENSE", "/?x=1"):
        assert page.ask(path).status == 404


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1", "localhost:1", "", "127.0.0.1.evil.example"]
)
def test_other_names_of_this_machine_are_refused(page, host):
    assert page.ask("/events", Host=host).status == 403


def test_its_own_names_are_not(page):
    for name in NAMES:
        assert page.ask("/", Host=f"{name}:{page.server.server_port}").status == 200


def test_only_this_machine_can_ask(page):
    assert page.server.server_address[0] == "127.0.0.1"


def test_what_the_page_is_told(page):
    page.feed(as_csv(plant(500)))
    (begin, names), (row, event) = page.events(2)
    assert (begin, row) == ("begin", "row")
    assert names["parameters"] == ["y(k-1)", "u(k-1)", "offset"]
    estimator = page.stream.learner.estimator
    assert event["row"] == 500 and event["time"] == 49.9
    assert event["theta"][:2] == estimator.theta[:2].tolist()
    assert len(event["standard_errors"]) == 3
    assert event["error"][0] < 0 < event["error"][1]
    assert event["counts"] == str(page.stream.tally)


def test_alarms_are_told_once(page):
    rows = plant(1500)
    rows[700:, 2] += 5.0
    page.feed(as_csv(rows))
    (_, begin), (_, event) = page.events(2)
    assert begin["alarms"] == []
    assert [each["alarm"] for each in event["alarms"]] == ["change", "change"]
    time.sleep(told.INTERVAL)
    page.feed(as_csv(plant(3))[len(b"t_s,u,y\n") :])
    (_, begin), (_, first), (_, second) = page.events(3)
    assert begin["alarms"] == [] and len(first["alarms"]) == 2 and second["alarms"] == []


def test_no_more_than_ten_events_a_second(page, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(told.time, "monotonic", lambda: now[0])
    header, *lines = as_csv(plant(1000)).splitlines(keepends=True)
    page.feed(header)
    for line in lines:
        now[0] += 0.01
        page.feed(line)
    assert 90 <= page.server.events.count <= 101


def test_the_last_row_is_told_when_no_other_follows(page):
    page.feed(as_csv(plant(20)))
    page.feed(b"2.0,0.5,10.0\n")
    (_, _), (_, first), (_, last) = page.events(3)
    assert (first["row"], last["row"]) == (20, 21)


def test_events_of_hours_take_no_more_room(page, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(told.time, "monotonic", lambda: now[0])
    header, *lines = as_csv(plant(2 * told.KEPT)).splitlines(keepends=True)
    page.feed(header)
    for line in lines:
        now[0] += 1.0
        page.feed(line)
    assert len(page.server.events.kept) == told.KEPT


def test_too_many_pages(page):
    page.feed(as_csv(plant(20)))
    answers = [page.ask("/events") for _ in range(MOST)]
    assert {answer.status for answer in answers} == {200}
    assert page.ask("/events").status == 503
    for answer in answers:
        answer.close()


def test_a_port_that_is_taken(page):
    port = page.server.server_port
    done = command(*PLANT, "--live", "--port", port, data=as_csv(plant(3)))
    assert done.returncode == 2 and f"port {port} of this machine" in done.stderr.decode()


def test_port_without_page():
    done = command(*PLANT, "--port", "0", data=as_csv(plant(3)))
    assert done.returncode == 2 and "--live" in done.stderr.decode()


def test_the_command_says_where_it_is():
    done = command(*PLANT, "--live", "--port", "0", "--fields", "row", data=as_csv(plant(3)))
    assert done.returncode == 0 and done.stdout.count(b"\n") == 3
    assert re.search(r"live at http://127\.0\.0\.1:\d+/", done.stderr.decode())


def browse(page: Page, width: int, folder) -> str:
    """The page as Chromium has drawn it.

    Its time stands still while an answer is under way, so it shows the page once the stream ends.
    """
    arguments = [
        CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--window-size={width},1400",
        f"--user-data-dir={folder}", "--virtual-time-budget=3000", "--dump-dom",
        page.server.address,
    ]  # fmt: skip
    process = subprocess.Popen(
        arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        deadline = time.monotonic() + 60
        while not page.server.pages and time.monotonic() < deadline:
            time.sleep(0.1)
        time.sleep(2.0)
        page.server.stop()
        return process.communicate(timeout=60)[0]
    finally:
        process.kill()
        process.wait()


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed: apt-get install chromium")
@pytest.mark.parametrize("width", [1200, 390])
def test_a_browser_draws_it(tmp_path, width):
    """Charts stand on the page, names are text whatever they hold, and nothing is too wide."""
    name = "<img src=x onerror=alert(1)>"
    made = Page(Settings(output=("y",), input=(name,), arx=(1, 1, 1), time="none"))
    rows = plant(1500)
    rows[700:, 2] += 5.0
    made.feed(as_csv(rows, f"t_s,{name},y"))
    drawn = browse(made, width, tmp_path)
    assert drawn.count("<canvas") == 2 + 3
    assert "<img" not in drawn and "&lt;img src=x onerror=alert(1)&gt;(k-1)" in drawn
    assert "change begins" in drawn and "1500 rows: 1499 used" in drawn
    widths = [int(found) for found in re.findall(r'class="uplot"[^>]*?width: ?(\d+)px', drawn)]
    assert all(found <= width for found in widths)
