# SPDX-License-Identifier: GPL-3.0-or-later
"""What does not fit into memory is refused before anything is computed; a run leaves nothing."""

import gc
import weakref

import numpy as np
import pytest
import shapes

from solver import PAPER, CubicCraftError, Run, Setup, Stylization, rest_mesh
from solver.surface import memory


def test_what_does_not_fit_is_refused_with_both_sizes_and_a_cure(monkeypatch):
    monkeypatch.setattr(memory, "free_memory", lambda: 1_500_000)
    V, F = shapes.sphere(3)
    with pytest.raises(CubicCraftError, match=r"642 vertices need about 0\.0 GB.*Decimate"):
        rest_mesh(V, F, PAPER)
    monkeypatch.setattr(memory, "free_memory", lambda: 3_200_000_000)
    with pytest.raises(CubicCraftError, match=r"5,000,000 .* 13\.5 GB .* only 3\.2 GB are free"):
        memory.check_memory(5_000_000, 10_000_000)


@pytest.mark.parametrize("free", [None, 1_750_000])
def test_what_fits_or_may_fit_is_computed(monkeypatch, free):
    monkeypatch.setattr(memory, "free_memory", lambda: free)
    V, F = shapes.sphere(3)
    assert len(rest_mesh(V, F, PAPER).V) == len(V)


def test_triangles_count_where_there_are_many(monkeypatch):
    monkeypatch.setattr(memory, "free_memory", lambda: 100 * memory.BYTES_PER_VERTEX)
    memory.check_memory(100, 200)
    with pytest.raises(CubicCraftError):
        memory.check_memory(100, 202)


def test_free_memory_is_that_of_this_machine():
    free = memory.free_memory()
    assert free is not None
    assert 1e7 < free < 1e14
    assert any(is_taking_seen() for _ in range(20)), "what is taken is still free"


def is_taking_seen(size=1 << 29):
    """Take so many bytes; tell whether they are missed. Other programs may give some back then."""
    before = memory.free_memory()
    taken = np.ones(size, np.uint8)
    return memory.free_memory() < before - taken.nbytes / 2


@pytest.mark.parametrize("content", ["", "MemTotal: 5 kB\n", "nonsense\n"])
def test_a_system_that_hides_it_refuses_nothing(monkeypatch, tmp_path, content):
    hidden = tmp_path / "meminfo"
    hidden.write_text(content)
    monkeypatch.setattr(memory, "_LINUX", hidden)
    monkeypatch.setattr(memory.sys, "platform", "linux")
    assert memory.free_memory() is None
    monkeypatch.setattr(memory, "_LINUX", tmp_path / "none")
    assert memory.free_memory() is None


def test_windows_structure_has_its_documented_size():
    assert memory.ctypes.sizeof(memory._MemoryStatus) == 64


@pytest.mark.parametrize("steps", [3, None])
def test_a_run_is_freed_as_soon_as_it_is_not_used(steps):
    V, F = shapes.sphere(3)
    run = Run(Stylization(Setup(rest_mesh(V, F)), 0.4))
    gc.disable()  # in a program with few objects, it may look for cycles after ten runs
    try:
        while run.reason is None and (steps is None or run.steps < steps):
            run.advance()
        freed = weakref.ref(run)
        del run
        assert freed() is None
    finally:
        gc.enable()
