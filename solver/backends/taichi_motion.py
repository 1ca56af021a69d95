# SPDX-License-Identifier: GPL-3.0-or-later
"""The positions of a run on a large mesh or on a GPU, moved by kernels. See `Motion`."""

from functools import cache

import numpy as np

from ..global_step.motion import largest
from .engine_lock import alone
from .taichi_cycle import TaichiCycle
from .taichi_runtime import warm_up


class TaichiMotion:
    """As `Motion`, where the global step is a V-cycle.

    One pass over the vertices finds how each component has moved as a whole, and another one takes
    that back, extrapolates and measures. Between them only the sums of `Topology.groups` are looked
    at in NumPy. The positions lie where the arrays of the local step do.

    `setup`, `local`, `U`, `constraints`: as in `Motion`; the local step is one of Taichi.
    """

    @alone
    def __init__(self, setup, local, U, constraints=()):
        self._local, self._is_anchored = local, setup.global_step.is_anchored
        self._constraints = constraints
        rest, real, arrays = setup.rest, local.real, local.arrays
        keep = arrays.keep
        self._kernels = motion_kernels(local.precision)
        multigrid = setup.global_step.multigrid
        self._cycle = TaichiCycle(multigrid, arrays)
        scale = keep(multigrid.scale)
        topology = rest.topology
        (bounds, of_chunk), (groups, self._component) = topology.chunks, topology.groups
        bounds, chunks, groups = keep(bounds), keep(of_chunk), keep(groups)
        share = topology.shares(rest.weighing)
        self._center = topology.sum_parts(share[:, None] * rest.V)
        V, share = keep(rest.V.astype(real)), keep(share.astype(real))
        # only asked for where a component has to be kept from turning
        self._P, self._pull = (keep(np.zeros_like(rest.V, real)) for _ in range(2))
        self._is_kept = False
        self._setup = setup
        # of each chunk, and of each group; the latter are few, and written to NumPy at once
        self._sums, self._largest = (
            [keep(np.zeros((len(of_chunk), k), real)), np.zeros((len(self._component), k), real)]
            for k in (6, 3)
        )
        self._U, self.point = (keep(np.array(U, real)) for _ in range(2))
        X = self._cycle.X
        self._of_residual = local.residual_arguments(self.point, scale, self._cycle.B)
        of_share = bounds, share, self._pull
        self._of_moments = *of_share, self.point, scale, X, groups, *self._sums
        self._before_motion = bounds, chunks, V, scale, X, self._P
        self._after_motion = self.point, self._U, groups, *self._largest
        still = np.zeros((len(self._center), 8))
        self.compile_seconds = warm_up(
            [
                (self._kernels.residual, self._of_residual),
                (self._kernels.moments, self._of_moments),
                (self._kernels.move, self._move_arguments(still)),
                *self._cycle.calls(),
            ]
        )

    @property
    def positions(self):
        """(n,3) float64 present positions in the unit box."""
        return self._local.arrays.fetch(self._U).astype(np.float64)

    def put(self, U):
        """Go to other positions (n,3)."""
        self._local.arrays.put(self._U, U)
        self._local.arrays.put(self.point, U)

    def look_at_positions(self):
        """Let the next local step look at the positions themselves."""
        self._local.arrays.copy(self._U, self.point)

    def relax(self, times):
        """Come nearer to what the rotations ask for, without momentum or turning."""
        for _ in range(times):
            self.step(np.zeros(len(self._center)), np.zeros(len(self._center)), False)

    @alone
    def step(self, momentum, overshoot, keep_rotation):
        """Do one global step; see `Motion.step`."""
        parts = self._upright_parts(keep_rotation)
        is_constrained = parts is not None or len(self._constraints) > 0
        before = self.positions.copy() if is_constrained else None
        self._local.start_device()
        self._kernels.residual(*self._of_residual)
        self._cycle.run()
        motion = np.column_stack([*self._whole(keep_rotation), momentum, overshoot])
        self._kernels.move(*self._move_arguments(motion))
        if before is not None:
            return self._impose(parts, before)
        displacement, distance, _ = self._largest[1].max(axis=0)
        return float(displacement), float(distance)

    def _upright_parts(self, keep_rotation):
        if not keep_rotation or self._is_anchored.all():
            return None
        parts = self._setup.global_step.upright_parts
        return parts if parts.is_kept.any() else None

    def _impose(self, parts, before):
        """Make the positions obey all constraints, and with them where the next local step looks.

        In NumPy: it takes the arrays from a GPU and back, but only those who ask for them wait.
        Return displacement and distance as `step`, of positions that obey them before and now.
        """
        arrays = self._local.arrays
        kept = self._U, self.point
        values = [np.array(arrays.fetch(places)) for places in kept]
        if parts is not None:
            parts.impose(*values)
        for places, array in zip(kept, values, strict=True):
            for constraint in self._constraints:
                constraint.impose(array)
            arrays.put(places, array)
        now = self.positions
        return largest(now - before), largest(now - self._setup.rest.V)

    def _move_arguments(self, motion):
        return *self._before_motion, motion.astype(self._local.real), *self._after_motion

    def _whole(self, keep_rotation):
        """Return twists (c,3) and shifts (c,3) of the components, see the kernel `move`."""
        count = len(self._center)
        twist = np.zeros((count, 3))
        if self._is_anchored.all():
            return twist, twist
        no_turning = self._setup.global_step.no_turning_by_cycles if keep_rotation else None
        if no_turning and not self._is_kept:
            self._local.arrays.put(self._P, no_turning.P)
            self._local.arrays.put(self._pull, no_turning.pull)
            self._is_kept = True
        self._kernels.moments(*self._of_moments)
        sums = [np.bincount(self._component, column, count) for column in self._sums[1].T]
        means, torques = np.stack(sums[:3], axis=1), np.stack(sums[3:], axis=1)
        if no_turning:
            twist = no_turning.twist(torques)
        return twist, np.where(self._is_anchored[:, None], 0.0, self._center - means)


@cache
def motion_kernels(precision):
    """Return the kernels for "f64" or "f32"."""
    from .engine import ti
    from .taichi_motion_kernels import make_motion_kernels

    return make_motion_kernels(ti.f64 if precision == "f64" else ti.f32)
