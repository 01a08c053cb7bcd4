"""litz in a real Jupyter kernel: what its cells show."""

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

CELLS = [
    "import litz\nresults = litz.run(DECK, output_directory='.', progress=True)",
    "results.history",
    "litz.plot(results, 'history')",
    "litz.sweep(lambda side: side**2, {'side': [1.0, 2.0]}, directory=None)",
]


@pytest.fixture
def outputs(inputs, tmp_path, litz_program, monkeypatch):
    """What the kernel showed below each cell: for each output its kinds of data."""
    monkeypatch.setenv("LITZ_PROGRAM", str(litz_program))
    cells = [cell.replace("DECK", repr(str(inputs / "08_elastica.inp"))) for cell in CELLS]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    return [[output.get("data", {}) for output in cell.outputs] for cell in notebook.cells]


def test_a_kernel_shows_bars_tables_and_pictures(outputs):
    run, table, picture, sweep = outputs
    assert '<progress value="1.000"' in run[0]["text/html"]
    assert "08_elastica: finished" in run[0]["text/plain"]
    assert "<th>time</th>" in table[0]["text/html"]
    assert picture[0]["image/png"].startswith("iVBORw0KGgo")
    assert "2 of 2 runs" in sweep[0]["text/plain"]
    assert "<td>4</td>" in sweep[1]["text/html"]
