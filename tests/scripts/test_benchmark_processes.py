# SPDX-License-Identifier: GPL-3.0-or-later
"""How the benchmark takes measurements: processes of its own, and their memory."""

import fractions
import mmap
import os
import sys

import numpy as np
import pytest

from scripts.benchmark import shapes
from scripts.benchmark.machine import isolated, peak_memory


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
