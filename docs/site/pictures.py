"""Makes the pictures of the tutorials anew, by the code that the tutorials show: `python docs/site/pictures.py`."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from documents import blocks, setup_commands  # noqa: E402


def main():
    """Run the blocks of each tutorial in a folder of its own; keep the pictures that it shows."""
    for tutorial in sorted((ROOT / "docs" / "tutorials").glob("*.md")):
        wanted = re.findall(r"!\[[^\]]*\]\(\.\./pictures/([^)]+)\)", tutorial.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder:
            run(tutorial, Path(folder))
            for name in wanted:
                (made,) = Path(folder).rglob(name)
                keep_small(made, ROOT / "docs" / "pictures" / name)
                print(f"docs/pictures/{name}")


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
    """A picture with 256 colours, which is all that drawings need."""
    Image.open(source).convert("RGB").quantize(256, dither=Image.Dither.NONE).save(target, optimize=True)


if __name__ == "__main__":
    main()
