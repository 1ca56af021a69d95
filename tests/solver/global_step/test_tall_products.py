# SPDX-License-Identifier: GPL-3.0-or-later
"""Products of tall matrices by blocks: the same numbers, and the same bits on any cores."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from solver.global_step.tall_products import tall_product, transposed_product, weighted_sum

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("rows", [0, 1, 1023, 1024, 1025, 10_000])
@pytest.mark.parametrize("columns", [1, 3, 51])
def test_they_are_the_products(rows, columns):
    random = np.random.default_rng(rows)
    A, B, X = (random.random(shape) for shape in ((rows, columns), (rows, 3), (columns, 3)))
    np.testing.assert_allclose(tall_product(A, X), A @ X, rtol=1e-12)
    np.testing.assert_allclose(transposed_product(A, B), A.T @ B, rtol=1e-12)
    np.testing.assert_allclose(weighted_sum(A[:, 0], B), A[:, 0] @ B, rtol=1e-12)
    strided = np.repeat(A, 2, axis=1)[:, ::2]
    np.testing.assert_allclose(tall_product(strided, X), A @ X, rtol=1e-12)


START = f"""
import sys, time
sys.path.insert(0, {str(ROOT)!r})
import numpy as np
from solver.global_step.tall_products import tall_product, transposed_product
A = np.random.default_rng(0).random((100_003, 51))
"""


def output_of(code, cores):
    """Return what a process prints that may use so many cores, and starts with a matrix `A`."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": cores, "PYTHONHASHSEED": "0"}
    command = [sys.executable, "-c", START + code]
    done = subprocess.run(command, check=True, env=environment, capture_output=True, text=True)
    return done.stdout


def test_the_number_of_cores_changes_no_bit():
    code = """
print(transposed_product(A, A[:, :3].copy()).tobytes().hex())
print(hash(tall_product(A, A[:51, :3].copy()).tobytes()))
"""
    assert output_of(code, "1") == output_of(code, "2")


def test_they_keep_to_one_core():
    """A second one would be busy too, and count in the time of the process."""
    code = """
U, X = A[:, :3].copy(), A[:51, :3].copy()
of_process, passed = time.process_time(), time.perf_counter()
for _ in range(20):
    tall_product(A, X), transposed_product(A, U)
print((time.process_time() - of_process) / (time.perf_counter() - passed))
"""
    assert float(output_of(code, "2")) < 1.3
