# SPDX-License-Identifier: GPL-3.0-or-later
"""Products of tall matrices by blocks: the same numbers, and the same bits on any cores."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from solver.tall_products import tall_product, transposed_product

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("rows", [0, 1, 2047, 2048, 2049, 10_000])
@pytest.mark.parametrize("columns", [1, 3, 18])
def test_they_are_the_products(rows, columns):
    random = np.random.default_rng(rows)
    A, B, X = (random.random(shape) for shape in ((rows, columns), (rows, 3), (columns, 3)))
    np.testing.assert_allclose(tall_product(A, X), A @ X, rtol=1e-12)
    np.testing.assert_allclose(transposed_product(A, B), A.T @ B, rtol=1e-12)
    strided = np.repeat(A, 2, axis=1)[:, ::2]
    np.testing.assert_allclose(tall_product(strided, X), A @ X, rtol=1e-12)


def test_the_number_of_cores_changes_no_bit():
    code = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
import numpy as np
from solver.tall_products import tall_product, transposed_product
A = np.random.default_rng(0).random((100_003, 18))
print(transposed_product(A, A[:, :3]).tobytes().hex(), hash(tall_product(A, A[:18, :3]).tobytes()))
"""

    def with_cores(count):
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": count, "PYTHONHASHSEED": "0"}
        command = [sys.executable, "-c", code]
        return subprocess.run(
            command, check=True, env=environment, capture_output=True, text=True
        ).stdout

    assert with_cores("1") == with_cores("2")
