"""litz in a real Jupyter kernel: what its cells show."""

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

CELLS = [
    "import litz\nresults = litz.run(DECK, output_directory='.')",
    "results.history",
    "litz.plot(results, 'history')",
    "litz.sweep(lambda side: side**2, {'side': [1.0, 2.0]}, directory=None)",
    "litz.view(results)",
    "litz.view(results, open_browser=False)",
    "results",
    """
model = litz.Model('a wire')
wire = model.wire('W', (0, 0, 0), (0, 0, 1), elements=4, radius=0.01, material=litz.COPPER)
model
""",
    """
from litz.viewer.server import _IN_NOTEBOOK
from urllib.request import urlopen
[server] = _IN_NOTEBOOK.values()
print(server.url, b"<html" in urlopen(server.url).read())
""",
]


@pytest.fixture
def outputs(inputs, tmp_path, litz_program, monkeypatch):
    """What the kernel showed below each cell: for each output its kinds of data."""
    monkeypatch.setenv("LITZ_PROGRAM", str(litz_program))
    cells = [cell.replace("DECK", repr(str(inputs / "08_elastica.inp"))) for cell in CELLS]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    return [[output.get("data", output) for output in cell.outputs] for cell in notebook.cells]


@pytest.mark.slow
def test_a_kernel_shows_bars_tables_pictures_and_the_viewer(outputs):
    run, table, picture, sweep, viewer, link, inlined, model, served = outputs
    assert '<progress value="1.000"' in run[0]["text/html"]
    assert "08_elastica: finished" in run[0]["text/plain"]
    assert "<th>time</th>" in table[0]["text/html"]
    assert picture[0]["image/png"].startswith("iVBORw0KGgo")
    assert "2 of 2 runs" in sweep[0]["text/plain"]
    assert "<td>4</td>" in sweep[1]["text/html"]
    assert '<iframe src="http://127.0.0.1:' in viewer[0]["text/html"]
    assert "<iframe" not in link[0]["text/html"]
    # the model itself, and no address of a server that will be gone
    assert '<iframe srcdoc="&lt;!DOCTYPE html&gt;' in inlined[0]["text/html"]
    assert "127.0.0.1" not in inlined[0]["text/html"]
    assert "08_elastica.vtkhdf: 21 nodes" in inlined[0]["text/plain"]
    assert "W: 1 wire, 4 B33 elements" in model[0]["text/html"]
    assert '<img src="data:image/png;base64,' in model[0]["text/html"]
    assert "<Model 'a wire': 5 nodes, 4 elements" in model[0]["text/plain"]
    # the second viewer of a file ends the first
    url, answered = served[0]["text"].split()
    assert f'<a href="{url}"' in link[0]["text/html"]
    assert url not in viewer[0]["text/html"]
    assert answered == "True"
