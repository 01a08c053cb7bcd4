"""Output in Jupyter notebooks: progress bars and pictures instead of text and paths."""

import base64
import html
import importlib
import sys
from pathlib import PosixPath
from typing import Any

#: MIME types of the picture formats that notebooks display
_KINDS = {".png": "image/png", ".gif": "image/gif", ".jpg": "image/jpeg", ".jpeg": "image/jpeg"}


class Picture(PosixPath):
    """The path of a picture; a notebook displays the picture itself."""

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        """The current picture, or only its path if a notebook cannot display it."""
        shown = {"text/plain": repr(self)}
        if not self.is_file():
            return shown
        if self.suffix.lower() in _KINDS:
            shown[_KINDS[self.suffix.lower()]] = base64.b64encode(self.read_bytes()).decode()
        elif self.suffix.lower() == ".svg":
            shown["image/svg+xml"] = self.read_text(encoding="utf-8")
        return shown


class Html:
    """Output shown as HTML where possible, otherwise as text."""

    def __init__(self, content: str, text: str):
        self._html, self._text = content, text

    def __repr__(self) -> str:
        """The text."""
        return self._text

    def _repr_html_(self) -> str:
        return self._html


def shown_by(module: str, shown: object) -> str | None:
    """What a module of this package makes of an object for a notebook; it is loaded by name, as it uses what the object is of.

    Parameters
    ----------
    module : str
        Its name within the package; it has a function `frame`.
    shown : object
        What is to be shown.
    """
    return importlib.import_module(f"litz.{module}").frame(shown)


def in_notebook() -> bool:
    """Whether this runs in a notebook."""
    if "IPython" not in sys.modules:
        return False
    from IPython import get_ipython

    return hasattr(get_ipython(), "kernel")


def place() -> Any:
    """An output area of the notebook that `update` overwrites; None outside notebooks."""
    if not in_notebook():
        return None
    from IPython.display import display

    return display(bar(0.0, "starts"), display_id=True)


def show_page(url: str, text: str, *, framed: bool) -> None:
    """Show a link to a page, and the page in a frame if wanted."""
    from IPython.display import display

    link = html.escape(text).replace(url, f'<a href="{url}" target="_blank">{url}</a>')
    frame = f'<iframe src="{url}" style="width: 100%; height: 40em; border: 0"></iframe>'
    display(Html(f"<div>{link}{frame if framed else ''}</div>", text))


def bar(share: float, text: str) -> Html:
    """A progress bar with text beside it; a share of 1 is complete."""
    drawn = f'<progress value="{share:.3f}" max="1" style="width: 16em"></progress>'
    return Html(f"<div>{drawn} {html.escape(text)}</div>", text)
