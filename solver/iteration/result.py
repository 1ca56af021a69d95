# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run ends with, and the energy that it minimizes."""

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from ..aliases import FloatArray, IntArray
from ..values import Value

Reason: TypeAlias = Literal["converged", "max_iterations", "cancelled"]


@dataclass(frozen=True)
class Energy:
    """Energies in the unit box (divide lengths by the largest extent of the mesh).

    Examples
    --------
    >>> from solver import Energy
    >>> Energy(arap=0.25, cubic=0.5).total
    0.75
    """

    arap: float
    """of the as-rigid-as-possible deformation"""
    cubic: float
    """of the normals, which is lowest along the axes of the cube"""

    @property
    def total(self) -> float:
        """The energy that is minimized."""
        return self.arap + self.cubic


@dataclass(frozen=True, eq=False, repr=False)
class Result(Value):
    """The result of a run.

    Two results are equal if they agree bit for bit, apart from the times that they took.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import ball, stylize
    >>> V, F = ball()
    >>> result = stylize(V, F, 0.6, keep_rotation=True, device="numpy")
    >>> result.reason, result.device, result.positions.shape, result.rotations.shape
    ('converged', 'numpy', (700, 3), (700, 3, 3))
    >>> round(float(np.linalg.norm(result.positions - V, axis=1).max()), 2)  # the largest movement
    0.29
    """

    positions: FloatArray
    """(n,3) float64, in the units of the input"""
    rotations: FloatArray
    """(n,3,3) float64 rotation of each vertex; the identity for loose vertices"""
    energy: Energy
    """of the result, in the unit box"""
    iterations: int
    reason: Reason
    """"converged", "max_iterations" or "cancelled" """
    device: str
    """name of the device that ran the local step, such as "taichi-cpu" """
    compile_seconds: float = field(compare=False)
    """time to compile the kernels or to load them from a cache"""
    solve_seconds: float = field(compare=False)
    """time of the iterations"""
    crossings: int | None = None
    """triangles that are seen to cross others and did not at rest; None if not looked for"""
    pressed: int | None = None
    """how many of these are of parts that press into each other: to hold the parts apart would have
    taken back too much of the style"""
    crossing_vertices: IntArray | None = None
    """(k,) int vertices of these triangles"""

    @property
    def converged(self) -> bool:
        """Whether the stop rule ended the run."""
        return self.reason == "converged"
