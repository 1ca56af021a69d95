# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark makes, and runs with the artist's defaults."""

import subprocess

import pytest

from scripts.benchmark import defaults, earlier, shapes, without_taichi
from scripts.benchmark.machine import isolated
from scripts.benchmark.meshes import keep
from solver import ProxyOptions, rest_mesh

OLD_SOLVER = """
from types import SimpleNamespace

def stylize(V, F, cubeness, max_iterations=1000, on_iteration=None):
    print("[Taichi] a greeting")
    if on_iteration is not None:
        on_iteration(SimpleNamespace(energy=SimpleNamespace(total=0.5)))
    return SimpleNamespace(iterations=len(V), reason="of old")
"""


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
    for name, (rest, best) in results["bounds"].items():
        energies = [energy for _, energy in results[name][0]["curve"]]
        assert rest == energies[0] > best
        assert 0.0 <= min(energies) - best < 0.02 * (rest - best)


def test_both_devices_side_by_side(path):
    results = without_taichi.side_by_side(path, 0.4, runs=1)
    assert {name: len(runs) for name, runs in results.items()} == {"taichi": 1, "numpy": 1}
    (fast,), (plain,) = results.values()
    assert fast["iterations"] == plain["iterations"]
    assert fast["seconds"] != plain["seconds"]


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """Give a repository whose second commit has no solver any more."""
    git = ["git", "-C", str(tmp_path), "-c", "user.name=n", "-c", "user.email=e"]
    (tmp_path / "solver").mkdir()
    (tmp_path / "solver/__init__.py").write_text(OLD_SOLVER)
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "add", "."], check=True)
    subprocess.run([*git, "commit", "-q", "-m", "old"], check=True)
    monkeypatch.setattr(earlier, "_ROOT", tmp_path)
    monkeypatch.setattr(earlier, "COMMIT", "HEAD")
    subprocess.run([*git, "rm", "-qr", "solver"], check=True)
    return monkeypatch


def test_the_solver_of_an_earlier_commit(path, repository):
    first, second = earlier.earlier(path, 0.4, runs=2)
    assert first["iterations"] == 34  # vertices
    ((seconds, energy),) = first["curve"]
    assert 0.0 < seconds < first["seconds"] and energy == 0.5
    assert second["reason"] == "of old"


def test_without_its_history_there_is_nothing_earlier(path, repository):
    repository.setattr(earlier, "COMMIT", "0" * 40)
    assert earlier.earlier(path, 0.4, runs=2) == []


def test_memory_of_one_setting(path):
    figures = isolated(defaults.alone, path=path, cubeness=0.4, name="defaults")
    assert figures["peak"] > figures["above"] > 0
    assert "curve" not in figures  # a million vertices, many iterations


def test_ticks_go_on_after_the_restart(path):
    ticks = defaults.ticks(path, 0.4)
    assert len(ticks) > 1
    assert min(ticks) > 0.0
