# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page, its summaries and its targets make of given figures."""

import pytest

from scripts.benchmark import page, summary
from scripts.benchmark.suite import PARTS
from scripts.benchmark.targets import target, targets

MEBIBYTES = {"peak": 300 * 1024**2, "above": 100 * 1024**2}
NOTHING = {part: [] for part in PARTS} | {"machine": "A machine.", "runs": 3}


def run(speed=1.0, energy=1.0, reason="converged", **others):
    curve = [[0.5 * speed, 1.5], [1.0 * speed, 1.04], [2.0 * speed, 1.005], [4.0 * speed, energy]]
    figures = {"setup": 0.1 * speed, "seconds": 5.0 * speed, "iterations": 4}
    return figures | {"reason": reason, "curve": curve, "energy": energy} | others


@pytest.fixture
def case():
    return {
        **{"mesh": "horse", "vertices": 48_485, "cubeness": 0.4, "rest": 2.0, "best": 1.0},
        "ours": [run(), run(3.0), run(2.0)],
        "pymeshlab": [{"seconds": 80.0, "energy": 1.5}],
        **MEBIBYTES,
    }


@pytest.fixture
def results(case):
    head = {name: case[name] for name in ("mesh", "vertices", "cubeness")}
    defaults = {
        "paper": [run(0.2, solved=50_000)],
        "defaults": [run(0.24, solved=51_000)],
        "ticks": [0.025] * 4,
        "bounds": {"paper": [2.0, 1.0], "defaults": [2.0, 1.0]},
    }
    ten = {"mesh": "bunny", "vertices": 6172, "seconds": [0.3, 0.1, 0.2], "reading": [0.01]}
    return NOTHING | {
        "ten": [ten, ten | {"mesh": "blob"}],
        "race": [case],
        "scaling": [case],
        "defaults": [head | defaults],
    }


def rows_of(results):
    """Return {heading of a section: rows, each {heading of a column: cell}}."""
    found = {}
    for section in page.page(results).split("\n#")[1:]:
        lines = [line for line in section.splitlines() if line.startswith("|")]
        headings, _, *rows = ([cell.strip() for cell in line.split("|")[1:-1]] for line in lines)
        name = section.partition("\n")[0].strip("# ")
        found[name] = [dict(zip(headings, row, strict=True)) for row in rows]
    return found


@pytest.mark.parametrize(
    ("section", "cells"),
    [
        ("Ten iterations", "bunny | 6,172 | 0.01 | 0.2 | 3.55 | 27.6 | 17.7 | 138"),
        ("To the best shape", "horse | 48,485 | 0.4 | 2 | 4 | 8 | 10 | 4 | 0 | 0.2"),
        (
            "Beside PyMeshLab",
            "horse | 48,485 | 0.4 | 80 | 1.50000 | 50 | 1 | 80 | 10 | 1.00000 | 8",
        ),
        ("Time over size", "48,485 | 0.2 | 2,450 | 4 | 10 | 4 | 0 | 300 | 100"),
        (
            "With the defaults",
            "horse | 48,485 | 0.4 | 51,000 | 1 | 4 | 0.02 | 1.2 | 4 | 0.024 | 1.2 | 40",
        ),
        ("To the shape of the defaults", "horse | 48,485 | 0.4 | 0.2 | 0.4 | 0.24 | 0.48"),
    ],
)
def test_a_row_of_each_table(results, section, cells):
    assert list(rows_of(results)[section][0].values()) == cells.split(" | ")


def test_what_has_not_been_measured_has_no_row(results, case):
    assert rows_of(NOTHING) == {}
    assert "-" in rows_of(results)["Ten iterations"][1].values(), "the paper has no such mesh"
    case["pymeshlab"] = []
    assert "Beside PyMeshLab" not in rows_of(results)
    case["best"] = None
    (row,) = rows_of(results)["Time over size"]
    assert row["to gap 1 %, s"] == row["gap there, %"] == "-"


def test_the_page_says_which_settings_its_rows_have(results):
    sections = page.page(results).split("\n#")
    measured = [s for s in sections if "\n| mesh |" in s or "\n| vertices |" in s]
    assert len(measured) == 6
    assert all("paper" in section.partition("\n|")[0] for section in measured)


def test_the_first_time_counts_and_the_median_needs_every_run(case):
    curve = [(1.0, 9.0), (2.0, 5.0), (3.0, 6.0), (4.0, 4.0)]
    assert [summary.seconds_to_energy(curve, at) for at in (5.5, 4.0, 3.9)] == [2.0, 4.0, None]
    assert summary.median_seconds_to(case, "ours", 1.0) == 8.0
    case["ours"].append(run(energy=1.002))
    assert summary.median_seconds_to(case, "ours", 1.0) is None


def size(vertices, seconds, best=1.0):
    ours = [{"curve": [[seconds / 2, 1.5], [seconds, 1.0]]}]
    return {"vertices": vertices, "best": best, "rest": 2.0, "ours": ours}


def test_fit_leaves_out_small_sizes_and_those_without_a_best_energy():
    unknown = size(50_000, 77.0, best=None)
    cases = [size(1000, 50.0), size(10_000, 1.0), unknown, size(100_000, 10.0)]
    assert summary.fit(cases) == pytest.approx((1.0, 1e-4))
    assert summary.fit(cases[:2]) == (None, None)


@pytest.mark.parametrize(
    ("value", "bound", "is_met"),
    [
        (2.0, {"most": 2.0}, True),
        (2.1, {"most": 2.0}, False),
        (2.1, {"least": 2.0}, True),
        (1.9, {"least": 2.0}, False),
        (None, {"most": 2.0}, False),
    ],
)
def test_a_target_is_met_on_the_right_side_of_its_bound(value, bound, is_met):
    assert target("time", value, **bound)["met"] == ("yes" if is_met else "**no**")


def test_targets_of_what_was_measured(results):
    assert targets(NOTHING) == []
    found = {row["target"]: row["measured"] for row in targets(results)}
    assert found == {
        "horse 0.4, seconds to gap 5 %": "2.00",
        "horse 0.4, seconds to gap 1 %": "4.00",
        "horse 0.4, times sooner as low as PyMeshLab's end": "80.00",
        "bunny, ten iterations, times ahead of the paper's GPU": "17.75",
        "exponent of time over size": "never",
        "horse, with the defaults, seconds to our stop": "1.20",
        "horse, with the defaults, ticks of Live per second": "40.00",
    }


def test_the_defaults_are_judged_by_the_mean_over_all_cases(results):
    case = results["defaults"][0] | {"ticks": []}
    slower = case | {"paper": [run(4.0)], "defaults": [run(19.2)]}
    found = targets(NOTHING | {"defaults": [case, slower]})
    assert [row["measured"] for row in found] == ["2.40", "2.40"]
    never = case | {"bounds": {"paper": [2.0, 0.0], "defaults": [2.0, 0.0]}}
    assert targets(NOTHING | {"defaults": [never]})[1]["measured"] == "never"
