"""The picture of which members of a bank are believed when."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib import pyplot as plt

import forgetting as fg
from forgetting import plot


@pytest.fixture
def run():
    """A bank over more samples than a screen can show."""
    random = np.random.default_rng(1)
    phi = random.normal(size=(5000, 2))
    yield fg.Bank(2).run(phi, phi @ [1.0, 2.0] + random.normal(size=5000), outputs=["weights"])
    plt.close("all")


def test_the_weights_are_stacked_to_one(run):
    ax = plot.weights(run, [f"member {i}" for i in range(8)])
    assert len(ax.collections) == 8
    top = ax.collections[-1].get_paths()[0].vertices
    assert top[:, 1].max() == pytest.approx(1.0)
    assert top[:, 0].max() >= 4990 and len(top) < 5000
    assert [text.get_text() for text in ax.get_legend().get_texts()][-1] == "member 0"


def test_axes_are_used_and_returned(run):
    _, ax = plt.subplots()
    assert plot.weights(run, ax=ax) is ax
    assert ax.get_legend() is None


def test_a_run_without_weights_is_refused(run):
    with pytest.raises(fg.InvalidInput, match="weights"):
        plot.weights(fg.RLS(2).run([[1.0, 2.0]], [3.0]))
    with pytest.raises(fg.InvalidInput, match=r"labels has 2 names.*each of 8"):
        plot.weights(run, ["a", "b"])
