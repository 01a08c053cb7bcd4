"""Commands load matplotlib without what they do not ask of it; all of it is there afterwards."""

import subprocess
import sys

PROGRAM = """
import sys
from litz.pictures.loading import load_matplotlib
load_matplotlib()
from matplotlib.lines import Line2D
from matplotlib.artist import kwdoc
from matplotlib.figure import Figure
assert "linewidth" in kwdoc(Line2D)
assert "mpl_toolkits.mplot3d" not in sys.modules
figure = Figure()
(line,) = figure.subplots().plot([0, 1], linewidth=2)
assert line.get_linewidth() == 2
from mpl_toolkits.mplot3d import Axes3D
figure.add_axes(Axes3D(figure)).plot([0, 1], [0, 1], [0, 1])
figure.canvas.draw()
"""


def test_what_commands_leave_out_can_be_loaded_later():
    done = subprocess.run([sys.executable, "-W", "error", "-c", PROGRAM], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
