# SPDX-License-Identifier: GPL-3.0-or-later
"""The problem of the local step, one per vertex."""

from dataclasses import dataclass, replace
from typing import Any

from ..algebra import columns, from_columns, product, take, times, trace
from ..aliases import FloatArray
from .cube import CUBE

BETTER = 1e-9
"""of the energy of a vertex with the cubeness 1, divided by its area"""


@dataclass(frozen=True)
class LocalProblem:
    """min over R in SO(3) of lam h(Q R n) - tr(R S), of n vertices at once."""

    S: FloatArray
    """(n,3,3) covariances, divided by the vertex areas"""
    normals: FloatArray
    """(n,3) unit normals, or zero where `lam` is"""
    Q: FloatArray
    """(n,3,3) or (1,3,3) orientations of the form"""
    lam: FloatArray
    """(n,) cubeness"""
    form: Any = CUBE
    """Cube or Polytopes: what the costs h are"""

    def part(self, rows):
        """Return the problems of some rows, by number."""
        S, normals, lam = (take(a, rows) for a in (self.S, self.normals, self.lam))
        Q = self.Q if len(self.Q) == 1 else take(self.Q, rows)
        return LocalProblem(S, normals, Q, lam, self.form.part(rows))

    def with_covariances(self, S):
        """Return the problems for other covariances (n,3,3)."""
        return replace(self, S=S)

    def form_normals(self, R):
        """Return the rotated normals Q R n (n,3) in the frame of the form."""
        rotated = times(*columns(R), *self.normals.T)
        return from_columns(times(*columns(self.Q), *rotated))

    def starting(self, R):
        """Return the states (n,w) to begin with at rotations R (n,3,3)."""
        return self.form.starting(self.form_normals(R))

    def costs(self, R):
        """Return tr(R S) and h(Q R n), both (n,)."""
        fit = trace(*product(*columns(R), *columns(self.S)))
        return fit, self.form.cost(self.form_normals(R))

    def is_worse(self, R, last):
        """Return where R (n,3,3) costs more than `last`: taking it would raise the energy."""
        return self._gain(R, last) < 0.0

    def is_better(self, R, last):
        """Return where R (n,3,3) costs less than `last`, and not by rounding alone."""
        return self._gain(R, last) > BETTER * (1.0 + self.lam)

    def _gain(self, R, last):
        (fit, now), (last_fit, before) = self.costs(R), self.costs(last)
        return (self.lam * before - last_fit) - (self.lam * now - fit)
