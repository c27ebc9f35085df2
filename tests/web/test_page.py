"""The page in a browser: at desk and phone width, offline, with files as people have them."""

from __future__ import annotations

import pytest

from .conftest import BATTERY, Playground

NAME = "<img src=x onerror=alert(1)>"

FAULTS = {
    "empty": (b"", "the file is empty"),
    "blank lines": (b"\n\n\n", "the file is empty"),
    "names alone": (b"u,y\n", "no rows"),
    "words": (b"a,b\nx,y\nz,w\n", "numbers only"),
    "picture": (b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", "no text"),
    "nothing measured": (b"u,y\n1,\n2,\n3,\n", "in no row"),
    "beyond all numbers": (b"u,y\n1,1\n2,1e200\n3,2\n4,1e199\n", "row 2"),
}


@pytest.mark.parametrize("case", FAULTS)
def test_a_file_that_cannot_be_used_is_refused_in_words(case, playground, tmp_path):
    content, words = FAULTS[case]
    path = tmp_path / "wrong.csv"
    path.write_bytes(content)
    playground.page.select_option("#kind", "linear")
    playground.open(path)
    assert words in playground.page.inner_text("#fault")
    assert not playground.page.is_visible("#results")
    playground.open(BATTERY)  # and the next one is read
    assert playground.page.is_visible("#results")


TABLES = {
    "semicolons and decimal commas": "u;y\n" + "\n".join(f"{k % 7},5;{k},25" for k in range(60)),
    "tabs without names": "\n".join(f"{k % 7}.5\t{k}.25" for k in range(60)),
    "quotes, a comment, units and times": '# logger 7\nat,"u",y\n,V,K\n'
    + "\n".join(f'"2026-01-01 00:00:{k:02}",{k % 7}.5,"{k}.25"' for k in range(60)),
    "windows encoding": "Größe,y\n" + "\n".join(f"{k % 7}.5,{k}.25" for k in range(60)),
    "UTF-16": "u,y\n" + "\n".join(f"{k % 7}.5,{k}.25" for k in range(60)),
}


@pytest.mark.parametrize("case", TABLES)
def test_tables_are_read_as_they_are_written(case, playground, tmp_path):
    encoding = {"windows encoding": "cp1252", "UTF-16": "utf-16"}.get(case, "utf-8")
    path = tmp_path / "table.csv"
    path.write_bytes(TABLES[case].encode(encoding))
    playground.page.select_option("#kind", "linear")
    playground.open(path)
    y = playground.ask("Array.from(playground.found.samples.y)")
    u = playground.ask("Array.from(playground.found.samples.phi).filter((_, place) => place % 2)")
    assert y == [k + 0.25 for k in range(60)]
    assert u == [k % 7 + 0.5 for k in range(60)]
    if "times" in case:
        assert "at is left out" in playground.page.inner_text("#left-out")


def test_names_of_columns_are_text_whatever_they_hold(playground, tmp_path):
    path = tmp_path / "names.csv"
    path.write_text(f"{NAME},y\n" + "\n".join(f"{k % 7},{k}" for k in range(60)))
    playground.open(path)
    assert playground.page.query_selector("img") is None
    assert NAME in playground.page.inner_text("#parameters")


def test_a_wrong_order_is_refused_and_a_right_one_taken(playground):
    page = playground.page
    page.select_option("#kind", "arx")
    page.fill("#na", "-1")
    playground.wait("playground.error")
    assert "na = -1, allowed: whole numbers from 0 to 50" in page.inner_text("#fault")
    page.fill("#na", "2")
    playground.wait("playground.found && playground.found.samples.names.length === 5")
    assert page.is_visible("#results")


def test_a_parameter_out_of_range_is_refused_by_the_core(playground):
    playground.choose("V", ["I"], rule="exponential", factor=1.5)
    words = playground.page.inner_text("#fault")
    assert "forgetting_factor = 1.5" in words and "(0, 1]" in words


def test_the_slider_moves_the_memory(playground):
    playground.choose("V", ["I"], rule="exponential")
    long = playground.ask("playground.found.memory")
    playground.page.evaluate(
        """() => {
            const slider = document.getElementById("factor");
            slider.value = 260;
            slider.dispatchEvent(new Event("input"));
        }"""
    )
    playground.wait()
    factor = float(playground.page.input_value("#factor-number"))
    assert 0.9 < factor < 0.97
    assert playground.ask("playground.found.memory") < long / 2


def test_every_rule_of_the_list_runs(playground):
    names = playground.ask(
        "[...document.querySelectorAll('#rule select option')].map((option) => option.value)"
    )
    assert len(names) > 15
    for name in names:
        playground.choose("V", ["I"], rule=name)
        assert playground.ask("playground.error") == "", name


def test_windup_blows_up_exponential_forgetting_and_not_the_others(playground):
    page = playground.page
    page.click("#switch")
    assert page.inner_text("#switch") == "Switch the input on"
    playground.ask("playground.story.advance(600)")
    playground.ask("playground.story.draw()")
    exponential, subspace, walk = playground.ask(
        "playground.story.runners.map((each) => each.tell().variance)"
    )
    assert exponential > 1e3 * max(subspace, walk)
    worst = playground.ask(
        "playground.story.runners.map((each) => Math.max(...each.estimates.map((value) => "
        "Math.abs(value - 2))))"
    )
    assert worst[0] > 5 * max(worst[1:])
    assert page.locator("#story-legend li").count() == 3


def test_the_story_runs_by_itself(playground):
    before = playground.ask("playground.story.plant.k")
    playground.page.click("#run")
    playground.wait(f"playground.story.plant.k > {before + 20}")
    playground.page.click("#run")
    stopped = playground.ask("playground.story.plant.k")
    playground.page.wait_for_timeout(200)
    assert playground.ask("playground.story.plant.k") <= stopped + 3


@pytest.mark.parametrize("width", [1200, 390, 320])
def test_nothing_is_wider_than_the_screen(browser, width, tmp_path):
    made = Playground(browser, width)
    made.page.click("#plant")
    made.wait("playground.found.samples.names.length === 2")
    assert made.ask("document.documentElement.scrollWidth") <= width
    assert made.ask("document.querySelectorAll('canvas').length") == 2 + 2 + 2
    assert made.faults == []
    made.page.close()


def test_the_address_can_ask_for_a_rule_or_the_story_alone(browser):
    asked = Playground(browser, asked="#rule=efra&example=plant")
    assert asked.ask("playground.found.rule.name") == "efra"
    asked.page.close()
    asked = Playground(browser, asked="#only=windup&rule=data_dependent")
    assert asked.ask("playground.story.runners.map((each) => each.name)[1]") == "data_dependent"
    assert not asked.page.is_visible("#record") and asked.page.is_visible("#story")
    asked.page.close()
    # the rule that is shown by default beside another is not shown twice
    asked = Playground(browser, asked="#only=windup&rule=random_walk")
    names = asked.ask("playground.story.runners.map((each) => each.name)")
    assert len(set(names)) == len(names) == 3
    asked.page.close()


def test_a_long_record_is_taken(playground, tmp_path):
    path = tmp_path / "long.csv"
    path.write_text("u,y\n" + "\n".join(f"{k % 13},{(k * 7) % 31}" for k in range(100_000)))
    playground.open(path)
    assert playground.ask("playground.found.used.length") == 100_000
