"""The pictures of a page are those that its Python draws."""

import importlib.util
import shutil

import matplotlib as mpl
import pytest
from matplotlib import pyplot as plt

from .pages import ROOT

mpl.use("Agg")

spec = importlib.util.spec_from_file_location("pictures", ROOT / "docs" / "pictures.py")
pictures = importlib.util.module_from_spec(spec)
spec.loader.exec_module(pictures)

DRAWS = "```python\nfrom matplotlib import pyplot as plt\nplt.plot([1, 2])\n```\n"


@pytest.fixture(autouse=True)
def closed():
    plt.close("all")
    yield
    plt.close("all")


def test_every_picture_of_the_page_of_models_is_drawn(tmp_path):
    page = tmp_path / "models.md"
    shutil.copy(ROOT / "docs" / "models.md", page)
    pictures.draw(page)
    named = {match["name"] for match in pictures.PICTURE.finditer(page.read_text("utf-8"))}
    assert {path.name for path in (tmp_path / "pictures").iterdir()} == named
    assert len(named) >= 6 and not plt.get_fignums()


@pytest.mark.parametrize("text", [DRAWS, "```python\n```\n![x](pictures/x.png)\n"])
def test_a_picture_too_many_or_too_few_is_an_error(text, tmp_path):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page.md: \d figures drawn, \d named"):
        pictures.draw(page)


def test_a_block_draws_what_is_named_below_it(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(DRAWS + "![x](pictures/one.png)\n" + DRAWS + "![x](pictures/two.png)\n")
    pictures.draw(page)
    assert {path.name for path in (tmp_path / "pictures").iterdir()} == {"one.png", "two.png"}
