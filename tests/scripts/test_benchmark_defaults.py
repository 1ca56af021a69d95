# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark makes, and runs with the artist's defaults."""

import pytest

from scripts.benchmark import defaults, shapes
from scripts.benchmark.meshes import keep
from solver import ProxyOptions, rest_mesh


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
