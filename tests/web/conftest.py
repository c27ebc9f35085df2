"""The built module and page, and a browser: what `make web` made and brought."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
BUILT = ROOT / "build" / "web"
PAGE = BUILT / "playground.html"
MODULE = BUILT / "module"
BATTERY = ROOT / "python" / "forgetting" / "demo" / "data" / "battery.csv"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Only `make web` has built what is tested here."""
    if os.environ.get("FORGETTING_WEB") != "1":
        for item in items:
            if Path(__file__).parent in item.path.parents:
                item.add_marker(pytest.mark.skip(reason="make web builds and runs this"))


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Chromium without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield started
        started.close()


class Playground:
    """The page from its file, as a person uses it."""

    def __init__(self, browser: Any, width: int = 1200, asked: str = "") -> None:
        self.page = browser.new_page(viewport={"width": width, "height": 900})
        self.faults: list[str] = []
        self.asked_for: list[str] = []
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", self._note)
        self.page.on("request", lambda request: self.asked_for.append(request.url))
        self.page.goto(PAGE.as_uri() + asked)
        self.page.wait_for_selector("body[data-ready]")

    def _note(self, message: Any) -> None:
        if message.type in ("error", "warning"):
            self.faults.append(message.text)

    def open(self, path: Path) -> None:
        """Choose a file; wait until it is read or refused."""
        self.page.set_input_files("#file", path)
        self.wait()

    def wait(self, condition: str = "!playground.waiting") -> None:
        """Until this holds; asked from here, as the page allows no text to be run as code."""
        deadline = time.monotonic() + 30
        while not self.ask(f"Boolean({condition})"):
            assert time.monotonic() < deadline, condition
            self.page.wait_for_timeout(20)

    def ask(self, expression: str) -> Any:
        """The value of an expression in the page."""
        return self.page.evaluate(expression)

    def choose(
        self,
        output: str,
        inputs: list[str],
        arx: tuple[int, int, int] | None = None,
        constant: bool = True,
        rule: str = "auto",
        factor: float | None = None,
    ) -> None:
        """Fill in the form."""
        page = self.page
        page.select_option("#output", output)
        for box in page.query_selector_all("#inputs input"):
            box.set_checked(box.get_attribute("value") in inputs)
        page.select_option("#kind", "linear" if arx is None else "arx")
        for name, value in zip(("na", "nb", "nk"), arx or (), strict=False):
            page.fill(f"#{name}", str(value))
        page.set_checked("#constant", constant)
        page.select_option("#rule select", rule)
        if factor is not None:
            page.fill("#factor-number", str(factor))
            page.press("#factor-number", "Enter")
        page.dispatch_event("#kind", "change")
        self.wait()


@pytest.fixture
def playground(browser: Any) -> Iterator[Playground]:
    """The page, which has asked for nothing else and complained of nothing when it closes."""
    made = Playground(browser)
    yield made
    assert made.faults == []
    assert made.asked_for == [PAGE.as_uri()]
    made.page.close()
