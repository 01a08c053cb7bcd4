"""`litz view`: results in the browser, from a small server on this machine."""

import gzip
import re
import sys
import threading
import webbrowser
from collections.abc import Callable
from functools import lru_cache
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from ..base import notebook
from ..errors import FileError, LitzError
from ..pictures.plots import with_increments
from ..results import Results
from .data import WebData
from .page import page, viewer, viewer_style

_STYLE = "html, body { height: 100%; margin: 0; }\n"
_ADDRESS = "127.0.0.1"
# Increments that are kept, and elements and nodes of all of these
_KEPT_INCREMENTS, _KEPT_CELLS = 32, 1_000_000
#: Servers of the viewers in a notebook, by their result files
_IN_NOTEBOOK: dict[Path, "ViewServer"] = {}


class ViewServer(ThreadingHTTPServer):
    """Serves the viewer of one result file, to this machine only.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    port : int
        0: any that is free.

    Attributes
    ----------
    url : str
        Where the browser finds it.
    """

    daemon_threads = True

    def __init__(self, results: Results | str | Path, port: int = 0):
        self.results = with_increments(results)
        self._data = WebData(self.results)
        cells = len(self.results.elements) + len(self.results.nodes)
        self.increment = lru_cache(max(1, min(_KEPT_INCREMENTS, _KEPT_CELLS // cells)))(self._increment)
        try:
            super().__init__((_ADDRESS, port), _Handler)
        except OSError as error:
            raise FileError(f"port {port} cannot be used: {error.strerror}; --port 0 uses a free one") from None
        self.url = f"http://{_ADDRESS}:{self.server_address[1]}/"

    def model(self) -> bytes:
        """The model, with all increments that the file has by now."""
        self._data = WebData(Results(self.results.path))
        self.increment.cache_clear()
        return self._data.model().encode()

    def _increment(self, place: int) -> bytes:
        if not 0 <= place < len(self._data.increments):
            raise FileError(f"there is no increment {place}; there are {len(self._data.increments)}")
        return self._data.increment(place).encode()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Report an error, unless the browser has closed the connection."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(request, client_address)

    def page(self) -> bytes:
        """The viewer as a page."""
        title = (self.results.heading.strip() or self.results.path.stem).splitlines()[0]
        return page(f"{title} - litz", viewer(), _STYLE + viewer_style()).encode()


class _Handler(BaseHTTPRequestHandler):
    server: ViewServer
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        """Answer a request of the browser."""
        # a DNS name of another site could resolve to the address of this machine
        if self.headers.get("Host", "").split(":")[0] not in (_ADDRESS, "localhost"):
            self._answer(HTTPStatus.FORBIDDEN, b"this server is for this machine only", "text/plain")
        elif self.path == "/":
            self._answer_with(self.server.page, "text/html; charset=utf-8")
        elif self.path == "/data/model":
            self._answer_with(self.server.model, "application/json")
        elif found := re.fullmatch(r"/data/increment-(\d{1,9})", self.path):
            self._answer_with(lambda: self.server.increment(int(found[1])), "application/json")
        else:
            self._answer(HTTPStatus.NOT_FOUND, b"there is no such page", "text/plain")

    def _answer_with(self, make: Callable[[], bytes], kind: str) -> None:
        try:
            content = make()
        except LitzError as error:
            self._answer(HTTPStatus.NOT_FOUND, str(error).encode(), "text/plain; charset=utf-8")
        else:
            self._answer(HTTPStatus.OK, content, kind)

    def _answer(self, status: HTTPStatus, content: bytes, kind: str) -> None:
        zipped = "gzip" in self.headers.get("Accept-Encoding", "")
        content = gzip.compress(content, 1) if zipped else content
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-store")
        if zipped:
            self.send_header("Content-Encoding", "gzip")
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_: object) -> None:
        """Do not log requests."""


def view(results: Results | str | Path, *, port: int = 0, open_browser: bool = True) -> None:
    """Show results in the browser until Ctrl-C ends it; in a notebook below the cell, until the kernel ends.

    Turn, move and enlarge the wires with the mouse, go through the increments, choose the scalar that colours them, click
    a contact to see its row of the ledger.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    port : int
        Port of this machine; 0: any that is free.
    open_browser : bool
        Open the page; else the address is only printed. In a notebook: show the viewer; else only its address.

    Notes
    -----
    Only the machine that runs litz can reach the address: in a notebook on another machine use `litz.report`.
    """
    if notebook.in_notebook():
        _view_in_notebook(results, port, open_browser)
        return
    with ViewServer(results, port) as server:
        print(f"{server.results.path} is shown at {server.url} (Ctrl-C to stop)", flush=True)
        if open_browser and not webbrowser.open(server.url):
            print("no browser was found: open the address manually", file=sys.stderr, flush=True)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()


def _view_in_notebook(results: Results | str | Path, port: int, shown: bool) -> None:
    """Serve the viewer in a background thread and show it; an earlier server of the same file ends."""
    results = with_increments(results)
    path = results.path.resolve()
    if path in _IN_NOTEBOOK:
        former = _IN_NOTEBOOK.pop(path)
        former.shutdown()
        former.server_close()
    server = _IN_NOTEBOOK[path] = ViewServer(results, port)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    notebook.show_page(server.url, f"{results.path} is shown at {server.url} until the kernel ends", framed=shown)
