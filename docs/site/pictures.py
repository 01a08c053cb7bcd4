"""Makes the pictures of the documents anew: `python docs/site/pictures.py`, or some of them, such as `pictures.py viewer rope`.

Those of the tutorials by the code that the tutorials show, the others by `COMMANDS` (that of 45 strands takes a run of seven
minutes); the viewer with a headless Chromium
(`apt-get install chromium chromium-driver`). `house.svg` is drawn by hand.
"""

import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

sys.path.insert(0, str(ROOT / "tests" / "system"))

from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402

import litz  # noqa: E402
from browser import open_browser  # noqa: E402
from documents import blocks, setup_commands  # noqa: E402
from litz.viewer.server import ViewServer  # noqa: E402

DECKS, PICTURES = ROOT / "inputs", ROOT / "docs" / "pictures"
#: Pictures that tutorials do not make: where they are, the deck, what is drawn, and how
COMMANDS = {
    ROOT / "docs" / "crossed_wires.png": ("01_crossed_wires", "overview", {"size": (1350, 765)}),
    PICTURES / "network.png": ("11_fibre_mat", "network", {"size": (900, 700)}),
    # at the end of the step that compacts it
    PICTURES / "cable_section.png": (
        "25_cable_of_45_strands",
        "section",
        {"increment": 20, "field": "axial_force", "size": (900, 800)},
    ),
}
#: The deck in the picture of the viewer, the contact that is selected, and the size of the window
VIEWED, SELECTED = "12_woven_fabric", 144
WINDOW = (1300, 840)
#: Of a picture with all colours
MOST_BYTES = 400_000


def main(wanted):
    """Make the pictures whose names contain one of some words; all without any."""

    def is_wanted(path):
        return not wanted or any(word in path.stem for word in wanted)

    for target, (deck, kind, options) in COMMANDS.items():
        if is_wanted(target):
            with tempfile.TemporaryDirectory() as folder:
                results = litz.run(DECKS / f"{deck}.inp", output_directory=folder, progress=False)
                keep_small(litz.plot(results, kind, Path(folder, "picture.png"), **options), target)
    if is_wanted(PICTURES / "viewer.png"):
        draw_viewer(PICTURES / "viewer.png")
    for tutorial in sorted((ROOT / "docs" / "tutorials").glob("*.md")):
        shown = re.findall(r"!\[[^\]]*\]\(\.\./pictures/([^)]+)\)", tutorial.read_text(encoding="utf-8"))
        targets = [path for path in map(PICTURES.joinpath, shown) if is_wanted(path) and path not in COMMANDS]
        if targets:
            with tempfile.TemporaryDirectory() as folder:
                run(tutorial, Path(folder))
                for target in targets:
                    (made,) = Path(folder).rglob(target.name)
                    keep_small(made, target)


def draw_viewer(target):
    """The viewer in the browser with a selected contact."""
    with tempfile.TemporaryDirectory() as folder, open_browser() as browser:
        results = litz.run(DECKS / f"{VIEWED}.inp", output_directory=folder, progress=False)
        with ViewServer(results) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            browser.set_window_size(*WINDOW)
            browser.get(server.url)
            ready = "return document.querySelector('.litz-viewer[data-ready=yes]') !== null"
            WebDriverWait(browser, 60).until(lambda _: browser.execute_script(ready))
            browser.execute_script(f"document.querySelector('.litz-viewer').viewer.select({SELECTED})")
            browser.save_screenshot(str(Path(folder, "viewer.png")))
            server.shutdown()
        keep_small(Path(folder, "viewer.png"), target)


def run(tutorial, folder):
    """The Python blocks as one script, in which the commands are run where they stand."""
    script = ["import matplotlib, subprocess", 'matplotlib.use("Agg")']
    for block in blocks(tutorial):
        if block.saved_as:
            (folder / block.saved_as).write_text(block.text)
        if block.language == "python" and not block.not_run:
            script.append(block.text)
        elif block.language == "sh" and not block.not_run and setup_commands(block) is None:
            script.append(f"subprocess.run(['bash', '-e', '-c', {block.text!r}], check=True)")
    subprocess.run([sys.executable, "-c", "\n".join(script)], cwd=folder, check=True, stdout=subprocess.DEVNULL)


def keep_small(source, target):
    """A picture with its colours, or with the 256 that it needs most where that would be large."""
    picture = Image.open(source).convert("RGB")
    picture.save(target, optimize=True)
    if target.stat().st_size > MOST_BYTES:
        # without further rounds there are many greys, and bars of colours in steps
        picture.quantize(256, kmeans=3, dither=Image.Dither.NONE).save(target, optimize=True)
    print(target.relative_to(ROOT))


if __name__ == "__main__":
    main(sys.argv[1:])
