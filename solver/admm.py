# SPDX-License-Identifier: GPL-3.0-or-later
"""Constants of the alternating direction method of multipliers (ADMM) of the local step.

Per vertex, and divided by its area a_i so that nothing depends on scale or tessellation:

    min over R in SO(3):  -tr(R S_i / a_i) + lam_i |Q R n_i|_1

is split by z = Q R n_i (Boyd et al., "Distributed Optimization and Statistical Learning via the
Alternating Direction Method of Multipliers", 2011, sections 3.1.1, 3.3.1 and 3.4.1).
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class AdmmOptions:
    """Tolerances and penalty of the ADMM. Penalties are in units of the vertex area."""

    max_iterations: int = 100
    absolute: float = 1e-7
    """absolute part of the tolerance of either residual"""
    relative: float = 1e-5
    """relative part of the tolerance of either residual"""
    rho_start: float = 2.0
    rho_min: float = 1e-2
    rho_max: float = 1e3
    balance: float = 10.0
    """mu: how far apart the residuals may be before the penalty changes"""
    factor: float = 2.0
    """tau: by how much the penalty then changes"""
