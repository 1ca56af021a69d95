# SPDX-License-Identifier: GPL-3.0-or-later
"""How the benchmark takes measurements: processes of its own, memory, clocks on functions."""

import sys

import numpy as np
import pytest

from scripts.benchmark import memory, phases, primitives
from scripts.benchmark.isolated import call


def test_call_in_another_process():
    assert call("gap", "energy_at_gap", wanted=0.5, rest=3.0, best=1.0) == 2.0


def test_failure_in_another_process():
    with pytest.raises(RuntimeError, match="must be above"):
        call("gap", "gap", energy=1.0, rest=1.0, best=1.0)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the peak cannot be reset")
def test_peak_memory_is_that_since_the_reset():
    size = 64 * 1024**2
    before = memory.resident_bytes()
    block = np.ones(size, np.uint8)
    assert memory.peak_bytes() > before + size // 2
    del block
    memory.reset_peak()
    assert memory.peak_bytes() < before + size // 2


def test_stopwatch_counts_what_is_inside_once(monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(phases.time, "perf_counter", lambda: clock[0])
    watch = phases.Stopwatch()

    def inner():
        clock[0] += 2.0

    timed_inner = watch.timed("inner", inner)

    def outer():
        clock[0] += 1.0
        timed_inner()
        timed_inner()
        return "result"

    assert watch.timed("outer", outer)() == "result"
    assert watch.seconds == {"outer": 1.0, "inner": 4.0}


def test_stopwatch_replaces_a_method():
    watch = phases.Stopwatch()
    original = primitives.blob
    try:
        watch.replace("making", "scripts.benchmark.primitives", "blob")
        primitives.blob(0)
    finally:
        primitives.blob = original
    assert watch.seconds["making"] > 0.0


def test_split_of_set_up_and_iteration():
    # set-up: 5 s of a, 2 s of what is not timed; each iteration: 1 s of a, 3 s of b, 0.5 s left
    marks = [(11.5 + 4.5 * k, {"a": 6.0 + k, "b": 3.0 + 3 * k}) for k in range(3)]
    result = phases.split(marks)
    assert result["setup"] == pytest.approx({"a": 5.0, "b": 0.0, "remainder": 2.0})
    assert result["iteration"] == pytest.approx({"a": 1000.0, "b": 3000.0, "remainder": 500.0})


def test_split_of_a_single_iteration():
    with pytest.raises(ValueError, match="not 1"):
        phases.split([(1.0, {})])


def test_blob_is_closed_and_faces_outward():
    V, F = primitives.blob(2)
    assert V.shape == (162, 3)
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    sides = {tuple(edge) for edge in edges.tolist()}
    assert len(sides) == len(edges)
    assert all((b, a) in sides for a, b in sides)
    assert len(V) - len(edges) // 2 + len(F) == 2
    assert np.einsum("fi,fi->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) > 0.0
