# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark makes, and runs with the artist's defaults."""

import pytest

from scripts.benchmark import defaults, shapes, without_taichi
from scripts.benchmark.machine import isolated
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
    # in a process of its own, since the solver's functions stay under the clock
    results = isolated(defaults.side_by_side, path=path, cubeness=0.4, runs=2)
    assert [len(results[name]) for name in defaults.SETTINGS] == [2, 2]
    paper, ours = (results[name][0] for name in defaults.SETTINGS)
    assert paper["links"] == 0.0
    assert 0.0 < ours["links"] < ours["setup"] < ours["seconds"]
    assert paper["solved"] == 34
    assert ours["solved"] > 1000


def test_both_devices_side_by_side(path):
    results = without_taichi.side_by_side(path, 0.4, runs=1)
    assert {name: len(runs) for name, runs in results.items()} == {"taichi": 1, "numpy": 1}
    (fast,), (plain,) = results.values()
    assert fast["iterations"] == plain["iterations"]
    assert fast["seconds"] != plain["seconds"]


def test_memory_of_one_setting(path):
    figures = isolated(defaults.alone, path=path, cubeness=0.4, name="defaults")
    assert figures["peak"] > figures["above"] > 0


def test_ticks_go_on_after_the_restart(path):
    ticks = defaults.ticks(path, 0.4)
    assert len(ticks) > 1
    assert min(ticks) > 0.0
