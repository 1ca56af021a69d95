# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark makes, and runs with the artist's defaults."""

import numpy as np
import pytest

from scripts.benchmark import defaults, made_meshes
from scripts.benchmark.isolated import call
from scripts.benchmark.meshes import keep
from solver import ProxyOptions, rest_mesh

SPHERE = made_meshes.sphere(8, 5)


@pytest.fixture
def path(tmp_path):
    return str(keep("sphere", tmp_path / "sphere.npz", *SPHERE).path)


@pytest.mark.parametrize(
    ("mesh", "parts"), [(made_meshes.character(3), 13), (made_meshes.dressed_body(3), 2)]
)
def test_parts_that_are_made_hang_together(mesh, parts):
    rest = rest_mesh(*mesh, proxy=ProxyOptions(solidity=0.0))
    assert rest.topology.part.max() + 1 == parts
    assert rest.topology.component_count == 1


def test_a_made_sphere_is_closed_and_faces_outward():
    V, F = SPHERE
    assert len(V) == 8 * 4 + 2
    edges = {tuple(edge) for k in range(3) for edge in F[:, [k, (k + 1) % 3]].tolist()}
    assert len(edges) == 3 * len(F)
    assert all((b, a) in edges for a, b in edges)
    assert np.einsum("fi,fi->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) > 0.0


def test_both_settings_side_by_side(path):
    # in a process of its own, since the solver's functions stay under the clock
    results = call("defaults", "side_by_side", path=path, cubeness=0.4, runs=2)
    assert [len(results[name]) for name in defaults.SETTINGS] == [2, 2]
    paper, ours = (results[name][0] for name in defaults.SETTINGS)
    assert paper["links"] == 0.0
    assert 0.0 < ours["links"] < ours["setup"] < ours["seconds"]
    assert paper["solved"] == 34
    assert ours["solved"] > 1000


def test_memory_of_one_setting(path):
    figures = call("defaults", "alone", path=path, cubeness=0.4, name="defaults")
    assert figures["peak"] > figures["above"] > 0


def test_ticks_go_on_after_the_restart(path):
    ticks = defaults.ticks(path, 0.4)
    assert len(ticks) > 1
    assert min(ticks) > 0.0
