"""Sphinx configuration. Nothing is fetched from a network, at build time or by the pages."""

import os
import sys
from pathlib import Path

import forgetting

# Figures are drawn by child code of sphinx-gallery, without a screen.
os.environ.setdefault("MPLBACKEND", "Agg")

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))  # for the folder `writing` beside this file

from pictures import draw  # noqa: E402
from writing import write_pages  # noqa: E402

project = "forgetting"
author = "the forgetting authors"
copyright = author
version = release = forgetting.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_design",
    "writing.katex",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = [
    "_build",
    "**.ipynb",
    "tutorials/*",
    "figures/*",
    "README.md",
    "**/node_modules",
]
suppress_warnings = [
    "config.cache",  # sphinx-gallery keeps objects in its configuration
    "ref.python",  # words such as "rows" in the shapes of docstrings are no references
]

html_theme = "furo"
html_title = "forgetting"
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css", "pages.css"]
html_js_files = ["katex/katex.min.js", "formulas.js"]
html_math_renderer = "katex"
PLAYGROUND = HERE.parent / "build" / "web" / "playground.html"  # where `make web` has built it
html_extra_path = [str(PLAYGROUND)] if PLAYGROUND.exists() else []
html_copy_source = False
html_show_sphinx = False
pygments_style = "friendly"
pygments_dark_style = "native"

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

autodoc_typehints = "none"  # the docstrings say shapes, units and ranges
autodoc_member_order = "bysource"
autodoc_mock_imports = ["pyspark"]  # too large to build pages with
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True

sphinx_gallery_conf = {
    "examples_dirs": ["tutorials", "figures"],
    "gallery_dirs": ["auto_tutorials", "auto_figures"],
    "filename_pattern": r"plot_",
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "remove_config_comments": True,
    "abort_on_example_error": True,
    "plot_gallery": True,
    "matplotlib_animations": False,
    "copyfile_regex": r".*\.rst",
    "nested_sections": False,
    "write_computation_times": False,
    "within_subsection_order": "FileNameSortKey",
}

write_pages(HERE)
draw(HERE / "models.md")


def unmark(app, what, name, obj, options, lines):
    """Leave |e| as it is, and a property's "P, (n, n): more" a sentence rather than a type."""
    for number, line in enumerate(lines):
        lines[number] = line.replace("|", "\\|") if "|" in line and "``" not in line else line
    if what in ("attribute", "property") and lines:
        lines[0] = lines[0].replace(": ", "; ")


def setup(app):
    if PLAYGROUND.exists():
        app.tags.add("playground")
    app.connect("autodoc-process-docstring", unmark, priority=400)  # before napoleon
