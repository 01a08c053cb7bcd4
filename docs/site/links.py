"""Checks the links inside a built site: `python links.py FOLDER`. External links are not followed, but nothing may be loaded
from elsewhere: the site is read without network.

FORD links from its lists to anchors that it does not write: in its folder only files are checked, not places in them.
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Links and anchors of one page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.loaded = [], set(), []
        self.feed(path.read_text(encoding="utf-8", errors="replace"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        self.links += [attributes[name] for name in ("href", "src") if attributes.get(name)]
        self.loaded += [attributes["src"]] if attributes.get("src") else []
        if tag == "link" and attributes.get("rel") in ("stylesheet", "icon", "preload"):
            self.loaded.append(attributes.get("href") or "")


def broken_links(folder):
    """Links of the pages below a folder that lead nowhere, as (page, link)."""
    folder = Path(folder).resolve()
    pages = {path: Page(path) for path in folder.rglob("*.html")}
    broken = []
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target /= "index.html"
            anchor = unquote(parts.fragment)
            if not target.is_file() or (
                anchor and target in pages and not has_anchor(folder, target, pages[target], anchor)
            ):
                broken.append((str(path.relative_to(folder)), link))
    return sorted(set(broken))


def loaded_from_elsewhere(folder):
    """Scripts, styles and pictures that pages below a folder load from a server, as (page, address)."""
    folder = Path(folder).resolve()
    found = {
        (str(path.relative_to(folder)), address)
        for path in folder.rglob("*.html")
        for address in Page(path).loaded
        if urlsplit(address).netloc
    }
    return sorted(found)


def has_anchor(folder, path, page, anchor):
    """Whether a page has a place of this name, as far as it is known."""
    return anchor in page.anchors or path.relative_to(folder).parts[0] == "fortran"


if __name__ == "__main__":
    broken, elsewhere = broken_links(sys.argv[1]), loaded_from_elsewhere(sys.argv[1])
    for name, link in broken:
        print(f"{name}: {link} leads nowhere")
    for name, address in elsewhere:
        print(f"{name}: needs a network for {address}")
    raise SystemExit(bool(broken or elsewhere))
