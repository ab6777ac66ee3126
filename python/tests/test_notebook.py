"""The notebook of the examples, with coarse cells and a short time."""

from __future__ import annotations

from pathlib import Path

import nbclient
import nbformat

EXAMPLES = Path(__file__).parent.parent / "examples"
COARSE = 'scenario.update(duration_s=0.3, numerics={"cell_size_m": 0.02})'


def test_the_notebook_makes_both_figures() -> None:
    notebook = nbformat.read(EXAMPLES / "source_paper.ipynb", as_version=4)
    reads_scenario = next(i for i, cell in enumerate(notebook.cells) if cell.cell_type == "code")
    notebook.cells.insert(reads_scenario + 1, nbformat.v4.new_code_cell(COARSE))

    resources = {"metadata": {"path": str(EXAMPLES)}}
    nbclient.NotebookClient(notebook, timeout=120, resources=resources).execute()

    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == 2
    assert any("onset" in output.get("text", "") for output in outputs)
