# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables and targets make of given figures."""

import pytest

from scripts.benchmark import page, summary, tables
from scripts.benchmark.suite import PARTS
from scripts.benchmark.targets import Target, targets

NOTHING = {part: [] for part in PARTS} | {"startup": {}}


def our_run(speed=1.0, energy=1.0, reason="converged"):
    curve = [[0.5 * speed, 1.5], [1.0 * speed, 1.04], [2.0 * speed, 1.005], [4.0 * speed, energy]]
    figures = {"setup": 0.1 * speed, "seconds": 5.0 * speed, "iterations": 4}
    return figures | {"reason": reason, "curve": curve, "energy": energy}


@pytest.fixture
def case():
    return {
        "mesh": "horse",
        "vertices": 48485,
        "cubeness": 0.4,
        "rest": 2.0,
        "best": 1.0,
        "ours": [our_run(), our_run(3.0), our_run(2.0)],
        "plain": [our_run(10.0, energy=1.003, reason="cancelled")],
        "pymeshlab": [{"seconds": 80.0, "energy": 1.5}],
        "long": None,
    }


def cells(text):
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()]


def test_table():
    assert tables.table(["a", "b"], [[1, 2.5]]) == "| a | b |\n| --- | --- |\n| 1 | 2.5 |"


@pytest.mark.parametrize(
    ("value", "text"), [(0.126, "0.13 s"), (12.34, "12.3 s"), (123.4, "123 s"), (None, "-")]
)
def test_seconds(value, text):
    assert tables.seconds(value) == text


def test_times():
    assert tables.times(3.0, 2.0) == "1.5"
    assert tables.times(4321.0, 1.0) == "4,321"
    assert tables.times(None, 2.0) == tables.times(2.0, None) == "-"


def test_gaps_are_medians_over_the_runs(case):
    assert cells(tables.gaps([case]))[2] == (
        ["horse", "48,485", "0.4", "2.00 s", "4.00 s", "8.00 s", "10.0 s (4)", "0 %", "0.20 s"]
    )


def test_gap_beyond_our_stop_is_in_brackets(case):
    case["best"] = 0.96
    case["long"] = our_run(4.0, energy=0.96)
    row = cells(tables.gaps([case]))[2]
    assert row[3:6] == ["4.00 s", "(16.0 s)", "(16.0 s)"]
    assert row[7] == "3.8 %"


def test_a_run_that_was_cut_off_is_marked(case):
    case["ours"].append(our_run(reason="cancelled"))
    assert "cut off" in tables.gaps([case])


def test_plain(case):
    row = cells(tables.plain([case]))[2]
    assert row[3:] == (["10.0 s", "5.0", "20.0 s", "5.0", "50.0 s (4, cut off)", "0.3 %"] + ["6.2"])


def test_pymeshlab(case):
    row = cells(tables.pymeshlab([case]))[2]
    assert row[3:] == (["80.0 s", "1.50000", "50 %", "1.00 s", "80", "10.0 s", "1.00000", "8.0"])


def test_cases_without_peer_have_no_row(case):
    case["pymeshlab"] = case["plain"] = []
    assert len(cells(tables.pymeshlab([case]))) == len(cells(tables.plain([case]))) == 2


def test_ten_iterations():
    results = [{"mesh": "bunny", "vertices": 6172, "seconds": [0.3, 0.1, 0.2]}]
    results[0]["reading"] = [0.01, 0.02, 0.03]
    results.append({"mesh": "blob", "vertices": 10242, "seconds": [1.0], "reading": [0.1]})
    bunny, blob = cells(tables.ten_iterations(results))[2:]
    assert bunny == ["bunny", "6,172", "0.02 s", "0.20 s", "3.55 s", "27.6 s", "18", "138"]
    assert blob == ["blob", "10,242", "0.10 s", "1.00 s", "-", "-", "-", "-"]


def test_scaling_without_a_best_energy(case):
    case |= {"peak": 300 * 1024**2, "above": 100 * 1024**2}
    assert cells(tables.scaling([case]))[2] == (
        ["48,485", "0.20 s", "2450.0", "4.00 s", "10.0 s", "4", "0 %", "300 MiB", "100 MiB"]
    )
    row = cells(tables.scaling([case | {"best": None}]))[2]
    assert (row[3], row[6]) == ("-", "-")


def test_phases():
    result = {"mesh": "horse", "vertices": 48485, "cubeness": 0.4, "peak": 0, "above": 0}
    result["setup"] = {"rest mesh": 0.3, "factorisation": 0.4, "solve": 0.1, "remainder": 0.2}
    result["iteration"] = {"local step": 20.0, "solve": 5.0, "remainder": 1.0}
    row = cells(tables.phases([result]))[2]
    assert row[3:10] == ["0.30 s", "0.40 s", "0.30 s", "20.0", "-", "5.0", "1.0"]


def test_startup():
    rows = cells(tables.startup({"monkey": [2.0, 3.0, 9.0], "bpy": [1.0], "solver": [0.5]}))
    assert [row[1] for row in rows[2:]] == ["3.00 s", "1.00 s", "2.00 s", "0.50 s"]


def test_lowest_energy_is_that_of_any_iteration(case):
    case["ours"][1]["curve"].insert(2, [2.5, 0.8])
    assert summary.lowest(case) == 0.8


def test_target_bounds():
    assert Target("", 2.0, 2.0).is_met
    assert not Target("", 2.1, 2.0).is_met
    assert Target("", 2.1, 2.0, is_least=True).is_met
    assert not Target("", None, 2.0).is_met
    assert Target("time", None, 2.0).line() == "FAIL  time: never (at most 2)"


def test_table_of_targets():
    lines = tables.targets([Target("time", 3.0, 2.0), Target("ratio", 3.0, 2.0, is_least=True)])
    assert lines.splitlines()[2:] == [
        "| time | 3.00 | at most 2 | **no** |",
        "| ratio | 3.00 | at least 2 | yes |",
    ]


def test_targets_of_what_was_measured(case):
    assert targets(NOTHING) == []
    found = {target.text: target for target in targets(NOTHING | {"race": [case]})}
    assert found["horse 0.4, seconds to gap 5 %"].value == 2.0
    assert found["horse 0.4, seconds to gap 1 %"].value == 4.0
    assert found["horse 0.4, times sooner as low as PyMeshLab's end"].is_met


def test_start_up_targets():
    startup = {"monkey": [2.4], "bpy": [0.5], "solver": [1.0]}
    first, ours = targets(NOTHING | {"startup": startup})
    assert first.is_met
    assert not ours.is_met


@pytest.fixture
def with_defaults():
    paper = {"seconds": 1.0, "iterations": 40, "setup": 0.2, "links": 0.0, "solved": 50_000}
    ours = {"seconds": 1.2, "iterations": 30, "setup": 0.6, "links": 0.25, "solved": 51_000}
    runs = {"reason": "converged", "peak": 300 * 1024**2, "above": 100 * 1024**2}
    figures = {"paper": [paper | runs], "defaults": [ours | runs], "ticks": [0.025] * 4}
    return {"mesh": "horse", "vertices": 50_000, "cubeness": 0.4} | figures


def test_defaults(with_defaults):
    row = cells(tables.defaults([with_defaults]))[2]
    ours = ["1.20 s (30)", "0.60 s", "0.25 s", "1.20", "40"]
    assert row[2:] == ["0.4", "51,000", "1.00 s (40)", "0.20 s", *ours]
    assert cells(tables.defaults([with_defaults | {"ticks": []}]))[2][-1] == "-"


def test_memory_of_defaults(with_defaults):
    row = cells(tables.memory_of_defaults([with_defaults]))[2]
    assert row[3:] == ["300 MiB", "100 MiB"] * 2


@pytest.mark.parametrize(
    ("vertices", "ticks", "names"),
    [
        (50_000, [], ["times as long as in the paper", "seconds of finding links"]),
        (1_000, [0.1, 0.2], ["seconds to our stop", "ticks of Live per second"]),
        (1_000_000, [], ["peak memory in GB"]),
        (20_000, [], []),
    ],
)
def test_targets_of_the_defaults(with_defaults, vertices, ticks, names):
    case = with_defaults | {"vertices": vertices, "ticks": ticks}
    found = targets(NOTHING | {"defaults": [case]})
    assert [target.text.rpartition(", ")[2] for target in found] == names


def test_the_page_says_which_settings_its_rows_have(case, with_defaults):
    case |= {"peak": 1, "above": 1}
    results = NOTHING | {"machine": "", "runs": 1, "race": [case], "scaling": [case]}
    sections = page.page(results | {"defaults": [with_defaults]}, None).split("\n#")
    rows = [
        section for section in sections if "\n| mesh |" in section or "\n| vertices |" in section
    ]
    assert len(rows) == 5
    assert all("paper" in section.partition("\n|")[0] for section in rows)
