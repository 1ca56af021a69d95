# SPDX-License-Identifier: GPL-3.0-or-later
"""Products of matrices of many rows and few columns, on one core.

OpenBLAS computes them on all cores. They have next to nothing to compute, but where another program
uses a core, each waits for it a hundred times as long as it takes, in every iteration. It leaves
small ones to one core, so here they are cut into blocks. With those, a result has the same bits on
any number of cores.
"""

import numpy as np

_ROWS = 1024
"""of a block. OpenBLAS takes more cores where rows times columns of both exceed 2**18, so this is
enough for the 51 columns that `upright_parts.py` may have with 3 others."""


def weighted_sum(weights, U):
    """Return the sum (q,) of the rows of a tall matrix (n,q), by weights (n,)."""
    return transposed_product(weights[:, None], U)[0]


def tall_product(A, X):
    """Return the product (n,q) of a tall matrix (n,p) and a small one (p,q)."""
    result = np.empty((len(A), X.shape[1]))
    blocks, rest = _blocks(A)
    into, into_rest = _blocks(result)
    np.matmul(blocks, X, out=into)
    np.matmul(rest, X, out=into_rest)
    return result


def transposed_product(A, B):
    """Return the product A'B (p,q) of tall matrices (n,p) and (n,q)."""
    (a, a_rest), (b, b_rest) = _blocks(A), _blocks(B)
    return (a.swapaxes(1, 2) @ b).sum(axis=0) + a_rest.T @ b_rest


def _blocks(A):
    """Return views of the blocks (k,rows,p) of a tall matrix and of what is left."""
    count = len(A) // _ROWS
    return A[: count * _ROWS].reshape(count, _ROWS, A.shape[1]), A[count * _ROWS :]
