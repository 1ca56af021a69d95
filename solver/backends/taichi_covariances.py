# SPDX-License-Identifier: GPL-3.0-or-later
"""What a local step reads of a vertex's neighbors, in Taichi: its covariance.

To import this imports the engine. These functions are compiled into the kernels
that call them. The loop over neighbors could end early, for an index that never comes: else LLVM
makes a vector loop of it, which gains nothing with six neighbors and takes as long to load as all
the rest.
"""

# pyright: reportInvalidTypeForm=false, reportGeneralTypeIssues=false, reportOptionalCall=false
# pyright: reportIndexIssue=false

from ..algebra import dot, outer
from .engine import ti


@ti.func
def covariance(
    kind: ti.template(),
    i,
    U: ti.template(),
    indptr: ti.template(),
    indices: ti.template(),
    gather: ti.template(),
    weights: ti.template(),
):
    """Return S_i of `spokes_and_rims.py`, and sum w |d|^2 over the edges d of vertex i."""
    here = U[i]
    S = kind.mat3(0.0)
    quadratic = kind.real(0.0)
    for entry in range(indptr[i], indptr[i + 1]):
        j = indices[entry]
        if j < 0:
            break
        edge = U[j] - here
        S += kind.mat3(ti.static(outer(*gather[entry], *edge)))
        quadratic += weights[entry] * ti.static([dot(*edge, *edge)])[0]
    return S, quadratic
