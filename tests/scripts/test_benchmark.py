# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark: how it measures, the energies that it keeps, and what its page says of them."""

import fractions
import json
import mmap
import os
import sys

import numpy as np
import pytest

from scripts.benchmark import defaults, page, shapes, summary
from scripts.benchmark.best_energies import BOOK, BestEnergies, keep_lower_energies
from scripts.benchmark.machine import isolated, peak_memory
from scripts.benchmark.meshes import keep
from scripts.benchmark.suite import PARTS
from scripts.benchmark.targets import target, targets
from solver import ProxyOptions, rest_mesh

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


def test_gap_is_one_at_rest_and_none_at_best(case):
    assert [summary.gap_of(case, energy) for energy in (2.0, 1.25, 1.0)] == [1.0, 0.25, 0.0]
    assert summary.gap_of(case, summary.energy_at_gap(0.05, 2.0, 1.0)) == pytest.approx(0.05)
    with pytest.raises(ValueError, match=r"1\.0 must be above .* 1\.0"):
        summary.gap_of(case | {"rest": 1.0}, 1.0)


def test_lowest_energy_is_that_of_any_iteration(case):
    case["ours"][1]["curve"].insert(2, [2.5, 0.8])
    assert summary.lowest(case) == 0.8


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


def test_fit_of_noise_is_that_of_least_squares():
    # in logarithms to the base 10 the points are (4, 0), (5, 1), (6, 1): slope 1/2
    cases = [size(10**4, 1.0), size(10**5, 10.0), size(10**6, 10.0)]
    assert summary.fit(cases) == pytest.approx((0.5, 10 ** (1 / 6 - 2)))


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


@pytest.fixture
def book(tmp_path):
    return tmp_path / "best.json"


def test_unknown(book):
    assert BestEnergies(book).get("bunny", 6172, 0.2) is None
    assert not book.exists()


def test_lower_energies_are_kept(book):
    best = BestEnergies(book)
    assert best.offer("bunny", 6172, 0.2, energy=0.6, found_by="a run")
    assert not best.offer("bunny", 6172, 0.2, energy=0.6, found_by="the same again")
    assert not best.offer("bunny", 6172, 0.2, energy=0.7, found_by="a worse run")
    assert best.offer("bunny", 6172, 0.2, energy=0.5, found_by="a better run")
    assert BestEnergies(book).get("bunny", 6172, 0.2) == 0.5
    assert "a better run" in book.read_text()


def test_size_and_cubeness_are_told_apart(book):
    best = BestEnergies(book)
    best.offer("bunny", 6172, 0.2, energy=0.6, found_by="")
    best.offer("bunny", 1000, 0.2, energy=0.7, found_by="")
    best.offer("bunny", 6172, 0.4, energy=0.8, found_by="")
    assert best.get("bunny", 6172, 0.2) == 0.6
    assert best.get("bunny", 1000, 0.2) == 0.7
    assert best.get("bunny", 6172, 0.4) == 0.8
    keys = ["bunny 1000 0.2", "bunny 6172 0.2", "bunny 6172 0.4"]
    assert list(json.loads(book.read_text())) == keys


def test_a_full_run_keeps_what_is_lower_or_new(book):
    best = BestEnergies(book)
    best.offer("bunny", 6172, 0.2, energy=0.6, found_by="")
    best.offer("horse", 48485, 0.2, energy=0.3, found_by="")

    def case(mesh, vertices, energy, known):
        ours = [{"energy": energy}, {"energy": 0.9}]
        return {"mesh": mesh, "vertices": vertices, "cubeness": 0.2, "ours": ours, "best": known}

    race = [case("bunny", 6172, 0.5, 0.55), case("horse", 48485, 0.4, 0.3)]
    keep_lower_energies({"race": race, "scaling": [case("bunny", 1000, 0.5, None)]}, best)
    assert best.get("bunny", 6172, 0.2) == 0.5
    assert best.get("horse", 48485, 0.2) == 0.3
    assert best.get("bunny", 1000, 0.2) == 0.5


def test_book_in_the_repository_can_be_read():
    keys = json.loads(BOOK.read_text())
    assert keys
    best = BestEnergies()
    for key in keys:
        mesh, vertices, cubeness = key.rsplit(" ", 2)
        assert best.get(mesh, int(vertices), float(cubeness)) > 0.0


@pytest.fixture
def path(tmp_path):
    return keep("sphere", tmp_path / "sphere.npz", *shapes.sphere(8, 5)).path


@pytest.mark.parametrize(
    ("mesh", "parts"), [(shapes.character(3), 13), (shapes.dressed_body(3), 2)]
)
def test_parts_that_are_made_hang_together(mesh, parts):
    rest = rest_mesh(*mesh, proxy=ProxyOptions(solidity=0.0))
    assert rest.topology.part.max() + 1 == parts
    assert rest.topology.component_count == 1


def test_both_settings_side_by_side(path):
    results = defaults.side_by_side(path, 0.4, runs=2)
    assert [len(results[name]) for name in defaults.SETTINGS] == [2, 2]
    paper, ours = (results[name][0] for name in defaults.SETTINGS)
    assert 0.0 < ours["setup"] < ours["seconds"]
    assert paper["solved"] == 34
    assert ours["solved"] > 1000
    for name, (rest, best) in results["bounds"].items():
        energies = [energy for _, energy in results[name][0]["curve"]]
        assert rest == energies[0] > best == min(energies)


def test_ticks_go_on_after_the_restart(path):
    ticks = defaults.ticks(path, 0.4)
    assert len(ticks) > 1
    assert min(ticks) > 0.0


def test_call_in_another_process():
    assert isolated(os.getpid) not in (os.getpid(), isolated(os.getpid))
    with pytest.raises(ZeroDivisionError):
        isolated(fractions.Fraction, numerator=1, denominator=0)


def fill(size):
    """Use memory that is new: NumPy may be given what other tests have freed."""
    with mmap.mmap(-1, size) as block:
        for begin in range(0, size, mmap.PAGESIZE):
            block[begin] = 1


def test_peak_memory_is_that_of_the_block():
    size = 64 * 1024**2
    fill(size)
    with peak_memory() as small:
        pass
    with peak_memory() as large:
        fill(size)
    assert large["peak"] > large["above"] > size // 2
    assert sys.platform != "linux" or small["above"] < size // 2, "elsewhere it cannot be reset"


@pytest.mark.parametrize("mesh", [shapes.blob(2), shapes.sphere(8, 5)], ids=["blob", "sphere"])
def test_a_made_shape_is_closed_and_faces_outward(mesh):
    V, F = mesh
    edges = {tuple(edge) for k in range(3) for edge in F[:, [k, (k + 1) % 3]].tolist()}
    assert len(edges) == 3 * len(F)
    assert all((b, a) in edges for a, b in edges)
    assert len(V) - len(edges) // 2 + len(F) == 2
    assert np.einsum("fi,fi->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) > 0.0
