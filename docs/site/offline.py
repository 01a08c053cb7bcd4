"""Makes the pages of FORD readable without network: `python offline.py FOLDER`, with the Python that has Bootstrap-Flask.

FORD leaves Bootstrap and MathJax on a server. Bootstrap is put beside the pages, as Bootstrap-Flask of the Python package index
brings it; MathJax is left out: comments in the sources have their formulas in plain letters.
"""

import importlib.metadata
import os
import re
import shutil
import sys
from pathlib import Path

_ELSEWHERE = re.compile(
    r"""<link\b[^>]*\bhref="https?://[^"]*"[^>]*>|<script\b[^>]*\bsrc="https?://[^"]*"[^>]*>\s*</script>""", re.DOTALL
)
_SETTINGS = re.compile(r"""<script type="text/x-mathjax-config">.*?</script>""", re.DOTALL)
# Files of FORD's server, and what stands for them; the bundle is Bootstrap with Popper
_BESIDE = {
    "bootstrap.min.css": ["css/bootstrap.min.css"],
    "bootstrap.bundle.min.js": ["umd/popper.min.js", "js/bootstrap.min.js"],
    "MathJax.js": [],
}


def make_self_contained(folder):
    """Replace what the pages below a folder load from elsewhere."""
    brought = {file.as_posix(): file.locate() for file in importlib.metadata.files("Bootstrap-Flask")}
    for path in (path for paths in _BESIDE.values() for path in paths):
        (folder / path).parent.mkdir(exist_ok=True)
        shutil.copyfile(brought[f"flask_bootstrap/static/bootstrap5/{path}"], folder / path)
    for page in folder.rglob("*.html"):
        to_top = os.path.relpath(folder, page.parent)
        text = _SETTINGS.sub("", page.read_text(encoding="utf-8"))
        page.write_text(_ELSEWHERE.sub(lambda tag, top=to_top: beside(tag[0], top), text), encoding="utf-8")


def beside(tag, to_top):
    """What loads the files beside the pages, in place of a tag that loads from elsewhere; unknown tags stay."""
    paths = next((paths for name, paths in _BESIDE.items() if f"/{name}" in tag), None)
    if paths is None:
        return tag
    kinds = {".css": '<link href="{}" rel="stylesheet">', ".js": '<script src="{}"></script>'}
    return "".join(kinds[Path(path).suffix].format(f"{to_top}/{path}") for path in paths)


if __name__ == "__main__":
    make_self_contained(Path(sys.argv[1]))
