# SPDX-License-Identifier: GPL-3.0-or-later
"""The file of the lowest energies: only lower ones are taken in."""

import json

import pytest

from scripts.benchmark.best_energies import BOOK, BestEnergies, keep_lower_energies


@pytest.fixture
def path(tmp_path):
    return tmp_path / "best.json"


def test_unknown(path):
    assert BestEnergies(path).get("bunny", 6172, 0.2) is None
    assert not path.exists()


def test_lower_energies_are_kept(path):
    best = BestEnergies(path)
    assert best.offer("bunny", 6172, 0.2, energy=0.6, found_by="a run")
    assert not best.offer("bunny", 6172, 0.2, energy=0.6, found_by="the same again")
    assert not best.offer("bunny", 6172, 0.2, energy=0.7, found_by="a worse run")
    assert best.offer("bunny", 6172, 0.2, energy=0.5, found_by="a better run")
    assert BestEnergies(path).get("bunny", 6172, 0.2) == 0.5
    assert "a better run" in path.read_text()


def test_size_and_cubeness_are_told_apart(path):
    best = BestEnergies(path)
    best.offer("bunny", 6172, 0.2, energy=0.6, found_by="")
    best.offer("bunny", 1000, 0.2, energy=0.7, found_by="")
    best.offer("bunny", 6172, 0.4, energy=0.8, found_by="")
    assert best.get("bunny", 6172, 0.2) == 0.6
    assert best.get("bunny", 1000, 0.2) == 0.7
    assert best.get("bunny", 6172, 0.4) == 0.8
    keys = ["bunny 1000 0.2", "bunny 6172 0.2", "bunny 6172 0.4"]
    assert list(json.loads(path.read_text())) == keys


def test_a_full_run_keeps_what_is_lower_or_new(path):
    best = BestEnergies(path)
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
