# SPDX-License-Identifier: GPL-3.0-or-later
"""How the benchmark takes measurements: processes of its own, memory, clocks on functions."""

import fractions
import mmap
import os
import sys
import types

import numpy as np
import pytest

from scripts.benchmark import cores, phases, shapes
from scripts.benchmark.machine import isolated, peak_memory
from scripts.benchmark.meshes import keep
from scripts.benchmark.startup import startup


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


def test_clock_on_functions(monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(phases.time, "perf_counter", lambda: clock[0])

    def work(seconds):
        clock[0] += seconds
        return "result"

    owner = types.SimpleNamespace(work=work, idle=work)
    seconds = phases.put_under_clock({"working": (owner, "work"), "idling": (owner, "idle")})
    assert owner.work(2.0) == owner.work(seconds=3.0) == "result"
    assert (seconds["working"], seconds["idling"]) == (5.0, 0)


def test_clock_while_any_of_some_functions_runs(monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(phases.time, "perf_counter", lambda: clock[0])

    def wait(seconds):
        clock[0] += seconds

    def begin_with(seconds, inner):
        clock[0] += seconds
        inner()

    owner = types.SimpleNamespace(outer=begin_with, inner=wait)
    both = phases.WhileAnyRuns({"one": (owner, "outer"), "other": (owner, "inner")})
    owner.outer(2.0, lambda: owner.inner(3.0))  # the other runs while the one does
    wait(10.0)
    owner.inner(1.0)
    assert both.seconds == 6.0


def test_split_of_set_up_and_iteration():
    # set-up: 5 s of a, 2 s of what is not timed; each iteration: 1 s of a, 3 s of b, 0.5 s left
    marks = [(11.5 + 4.5 * k, {"a": 6.0 + k, "b": 3.0 + 3 * k}) for k in range(3)]
    result = phases.split(marks)
    assert result["setup"] == pytest.approx({"a": 5.0, "b": 0.0, "remainder": 2.0})
    assert result["iteration"] == pytest.approx({"a": 1000.0, "b": 3000.0, "remainder": 500.0})


def test_phases_of_a_run(tmp_path):
    path = keep("blob", tmp_path / "blob.npz", *shapes.blob(2)).path
    result = isolated(phases.phases, path=path, cubeness=0.4)
    assert min(result["setup"]["rest mesh"], result["setup"]["factorization"]) > 0.0
    assert min(result["iteration"][name] for name in ("local step", "solve")) > 0.0
    assert result["peak"] > result["above"]


@pytest.mark.thorough
def test_what_of_an_iteration_runs_on_one_core(tmp_path):
    path = keep("blob", tmp_path / "blob.npz", *shapes.blob(2)).path
    found = cores.on_one_and_all(path, 0.4)
    assert found is not None and found["one"].keys() == found["all"].keys()
    assert min(found[name][phase] for name in ("one", "all") for phase in ("local step", "solve"))
    shares = [cores.serial_share(8.0, every, 4) for every in (1.0, 2.0, 5.0, 8.0, 9.0)]
    assert shares == [0.0, 0.0, 0.5, 1.0, 1.0]


@pytest.mark.parametrize("mesh", [shapes.blob(2), shapes.sphere(8, 5)], ids=["blob", "sphere"])
def test_a_made_shape_is_closed_and_faces_outward(mesh):
    V, F = mesh
    edges = {tuple(edge) for k in range(3) for edge in F[:, [k, (k + 1) % 3]].tolist()}
    assert len(edges) == 3 * len(F)
    assert all((b, a) in edges for a, b in edges)
    assert len(V) - len(edges) // 2 + len(F) == 2
    assert np.einsum("fi,fi->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) > 0.0


@pytest.mark.thorough
def test_each_program_has_a_first_result():
    assert startup(runs=0) == {"monkey": [], "bpy": [], "solver": []}, "else it raises"
