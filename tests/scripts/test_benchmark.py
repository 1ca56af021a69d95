# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark: how it measures, and what its page says."""

import pytest

from scripts.benchmark import page, runs
from scripts.benchmark.meshes import blob

NOTHING = {"machine": "A machine.", "runs": 3, "pymeshlab": [], "defaults": []}


def run(speed=1.0, reason="converged", **others):
    curve = [[0.5 * speed, 1.5], [1.0 * speed, 1.04], [4.0 * speed, 1.0]]
    figures = {"setup": 0.1 * speed, "seconds": 5.0 * speed, "iterations": 4}
    return figures | {"reason": reason, "curve": curve, "energy": 1.0, "solved": 50_000} | others


HEAD = {"mesh": "horse", "vertices": 48_485, "cubeness": 0.4}
OURS = {"ours": [run(), run(3.0), run(2.0)]}
RESULTS = NOTHING | {
    "pymeshlab": [HEAD | OURS | {"pymeshlab": [{"seconds": 80.0, "energy": 1.5}]}],
    "defaults": [HEAD | {"paper": [run(0.2)], "defaults": [run(0.24, "limit", solved=51_000)]}],
}


def rows_of(results):
    """Return {heading of a section: rows, each a list of cells}."""
    found = {}
    for section in page.page(results).split("\n##")[1:]:
        lines = [line for line in section.splitlines() if line.startswith("|")]
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines]
        found[section.partition("\n")[0].strip("# ")] = rows[2:]
    return found


@pytest.mark.parametrize(
    ("section", "cells"),
    [
        ("Beside PyMeshLab", "horse | 48,485 | 0.4 | 80 | 1.50000 | 1 | 80 | 10 | 1.00000 | 8"),
        (
            "With the defaults",
            "horse | 48,485 | 0.4 | 51,000 | 1 | 4 | 0.02 | 1.2 | 4, cut off | 0.024 | 1.2",
        ),
    ],
)
def test_a_row_of_each_table(section, cells):
    assert rows_of(RESULTS)[section][0] == cells.split(" | ")


def test_what_has_not_been_measured_has_no_row():
    assert rows_of(NOTHING) == {}


def test_the_first_time_counts_and_the_median_needs_every_run():
    assert page.seconds_to(OURS["ours"], 1.2) == 2.0
    assert page.seconds_to(OURS["ours"], 0.9) is None


def test_both_settings_in_turn():
    results = runs.both_settings(*blob(42), 0.4, runs=2)
    assert [len(results[name]) for name in runs.SETTINGS] == [2, 2]
    paper, ours = (results[name][0] for name in runs.SETTINGS)
    assert 0.0 < ours["setup"] < ours["seconds"]
    assert paper["solved"] == 42 and ours["solved"] > 1000
    assert paper["curve"][0][1] > paper["curve"][-1][1]
