# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples and the notebook run as they are stored, and draw what they promise."""

import json
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

NOTEBOOK = Path(__file__).parents[2] / "examples" / "cubic_forms.ipynb"


@pytest.fixture(scope="module")
def executed(tmp_path_factory):
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    folder = tmp_path_factory.mktemp("notebook")
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    assert not list(folder.iterdir())
    return notebook


def code(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def printed(cell):
    return "".join(each.text for each in cell.outputs if each.output_type == "stream")


def test_it_is_stored_without_outputs():
    cells = code(nbformat.read(NOTEBOOK, as_version=4))
    assert all(not cell.outputs and cell.execution_count is None for cell in cells)
    assert NOTEBOOK.read_text(encoding="utf-8").count("\n") > 20, "one line is no readable diff"
    assert json.loads(NOTEBOOK.read_text(encoding="utf-8"))["metadata"]["kernelspec"]["name"] == (
        "python3"
    )


def test_it_warns_of_nothing(executed):
    for cell in code(executed):
        for output in cell.outputs:
            assert output.get("name") != "stderr", output.text


def test_the_engine_says_nothing(tmp_path):
    """Taichi tells that it is in a notebook, unless it is told to be quiet before its import."""
    notebook = nbformat.v4.new_notebook()
    source = (
        "import cubic_craft\ncubic_craft.stylize([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]);"
    )
    notebook.cells = [nbformat.v4.new_code_cell(source)]
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert notebook.cells[0].outputs == []


def test_each_figure_is_drawn(executed):
    for cell in code(executed):
        pictures = [each for each in cell.outputs if "image/png" in each.get("data", {})]
        assert len(pictures) == cell.source.count("plt.subplots(")
        assert all(len(each.data["image/png"]) > 10_000 for each in pictures)
    assert sum(cell.source.count("plt.subplots(") for cell in code(executed)) == 4


def test_the_numbers_say_what_the_text_says(executed):
    energy, shares = (printed(cell) for cell in code(executed) if "print(" in cell.source)
    counts = {line.partition(":")[0]: int(line.split()[-2]) for line in energy.splitlines()}
    assert energy.count("converged") == 2 and counts["accelerated"] < counts["plain"]
    values = [float(word) for word in shares.split()[1::2]]
    assert values == sorted(values) and values[0] < 0.53 and values[-1] > 0.8


EXAMPLES = sorted((Path(__file__).parents[2] / "examples" / "library").glob("*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_draws_its_picture(path, tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "plot.png"
    done = subprocess.run(
        [sys.executable, path, picture], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert picture.stat().st_size > 10_000
