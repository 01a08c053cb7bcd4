"""Settings of Sphinx; `./setup docs` (build.py beside this file) runs it."""

import importlib
import importlib.metadata
import os
import site
import sys
from pathlib import Path

# litz is installed elsewhere, so that its sources stay where they are: only the .pth file there leads to it
for installed in filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep)):
    site.addsitedir(installed)
sys.path.insert(0, str(Path(__file__).parent))
pages = importlib.import_module("pages")

ROOT = Path(__file__).parents[2]

project = "litz"
author = "The litz authors"
project_copyright = "The litz authors, MIT licence"
release = version = pages.declared_version()

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx_copybutton",
    "pages",
]
exclude_patterns = ["site"]
nitpicky = False
suppress_warnings = ["myst.strikethrough"]

myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
# the fence of equations that other readers of Markdown know, too
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4
myst_url_schemes = ["http", "https"]

# Names of the fences, see tests/documents.py; a deck has no lexer of its own.
highlight_language = "text"
pygments_style = "friendly"

autodoc_typehints = "none"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
# types are words, as "path": as references they would lead to attributes of that name
napoleon_use_param = False
napoleon_use_rtype = False

html_theme = "furo"
html_title = f"litz {release}"
html_static_path = ["static"]
html_css_files = ["litz.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#9a4a16", "color-brand-content": "#9a4a16"},
    "dark_css_variables": {"color-brand-primary": "#e89a5f", "color-brand-content": "#e89a5f"},
}

# One file of MathJax, fonts and all its extensions included, out of a package of the Python index: pages need no network.
mathjax_path = "tex-svg-full.js"
mathjax_files = [
    file.locate() for file in importlib.metadata.files("sphinx-mathjax-offline") if file.name == mathjax_path
]
html_extra_path = []
