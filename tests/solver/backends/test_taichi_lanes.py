# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step of a few vertices at once, beside that of one after the other."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapes
from engine_marks import needs_taichi

from solver import PAPER
from solver.styles.admm import AdmmOptions
from solver.styles.cube import CUBE
from solver.surface.preparation import rest_mesh

ROOT = Path(__file__).parents[3]


@pytest.fixture(autouse=True)
def lanes_for_all(monkeypatch):
    monkeypatch.setattr("solver.backends.taichi_local_step.LANES_FROM", 0)


def local_steps(V, F, lam, Q):
    """Return the local step with lanes, and the same without."""
    from solver.backends.engine import ti
    from solver.backends.face_tables import face_tables
    from solver.backends.taichi_kernels import make_kernels
    from solver.backends.taichi_local_step import TaichiLocalStep

    rest = rest_mesh(V, F, PAPER)
    both = [TaichiLocalStep(rest, lam, Q, AdmmOptions()) for _ in range(2)]
    both[1]._kernels = make_kernels(ti.f64, 3, has_lanes=False)
    both[1]._tables = face_tables(CUBE.faces, both[1]._keep, both[1].arrays.keep)
    return rest, both


@pytest.mark.thorough(5)
@needs_taichi
@pytest.mark.parametrize("is_weighted", [False, True], ids=["one cubeness", "a map"])
@pytest.mark.parametrize("count", [162, 161, 159])
def test_lanes_change_nothing(is_weighted, count):
    """Also where some vertices are left out, turned inside out, or at the end of the mesh."""
    V, F = shapes.blob(2)
    F = F[F.max(axis=1) < count]  # so that the last lanes have no vertex
    V = V[:count]
    random = np.random.default_rng(1)
    lam = np.where(random.random(count) < 0.3, 0.0, 0.4) if is_weighted else np.full(count, 0.4)
    Q = np.stack([shapes.rotation(*angles) for angles in random.uniform(-90, 90, (count, 3))])
    rest, steps = local_steps(V, F, lam, Q)
    U, uncertified = rest.V.copy(), 0
    for _ in range(4):
        U += 0.05 * random.standard_normal(U.shape)
        U[10:20] = -U[10:20]
        energies = [step.update(U) for step in steps]
        lanes, alone = (step._arguments for step in steps)
        np.testing.assert_array_equal(lanes.certified, alone.certified)
        np.testing.assert_allclose(lanes.R, alone.R, rtol=0, atol=1e-11)
        np.testing.assert_allclose(energies[0], energies[1], rtol=1e-12)
        uncertified += np.count_nonzero(lanes.certified == 0)
    assert uncertified, "each vertex had an easy problem"


@pytest.mark.thorough
@needs_taichi
def test_lanes_are_vectors(tmp_path):
    """LLVM makes vector instructions of the loops, or without a word it does not."""
    code = f"""
import sys
sys.path[:0] = [{str(ROOT)!r}, {str(Path(__file__).parent)!r}]
import shapes
from solver import PAPER, stylize
from solver.backends import taichi_local_step
from solver.backends.taichi_runtime import set_cache_folder
set_cache_folder("cache")
taichi_local_step.LANES_FROM = 0
stylize(*shapes.blob(1), device="cpu", max_iterations=1, proxy=PAPER)
"""
    environment = {**os.environ, "TI_PRINT_KERNEL_LLVM_IR_OPTIMIZED": "1"}
    subprocess.run([sys.executable, "-c", code], check=True, cwd=tmp_path, env=environment)
    printed = [path.read_text() for path in tmp_path.glob("*.ll")]
    (kernel,) = (text for text in printed if "local_step" in text)
    products = [line for line in kernel.splitlines() if "fmul" in line]
    in_vectors = [line for line in products if " x double>" in line]
    # for a processor that Taichi's LLVM does not know: vectors of two, and more is left as it is
    is_unknown = sum("<2 x double>" in line for line in in_vectors) > 0.5 * len(in_vectors)
    assert len(in_vectors) > (0.5 if is_unknown else 0.7) * len(products)
