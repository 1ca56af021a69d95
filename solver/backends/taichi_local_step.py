# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step in Taichi, on the CPU or a GPU. See `NumpyLocalStep` for the interface."""

from functools import cache, partial
from types import SimpleNamespace
from typing import Any

import numpy as np

from ..global_step.motion import Motion
from ..styles.admm import admm_rotations
from ..styles.cube import CUBE
from ..styles.local_problem import LocalProblem
from . import taichi_runtime
from .arrays import arrays_for
from .engine_lock import alone
from .face_tables import face_tables
from .numpy_local_step import area_scale, local_cubeness
from .taichi_runtime import warm_up

LANES_FROM = 20_000
"""vertices from which the kernel of `taichi_lanes.py` pays: to compile it takes three times as
long, once on each machine, and then an iteration a twentieth less"""


class TaichiLocalStep:
    """Rotations from positions, and the right-hand side of the global step from rotations.

    `rest`, `lam`, `Q`, `options`, `form`, `normals`, `resolution`: as in `NumpyLocalStep`.
    `precision`: "f64" or "f32", by default f64 where the device has it. `device`: such as
    "taichi-cpu". `arrays`: HostArrays or DeviceArrays, where the arrays of the run lie; on a GPU
    they stay there. `compile_seconds`: to compile the kernels or to load them from the cache; 0
    after the first use.
    """

    @alone
    def __init__(
        self, rest, lam, Q, options, form: Any = CUBE, normals=None, *, device="cpu", precision=None
    ):
        self._wanted = device
        self.device, has_f64 = taichi_runtime.start(device)
        self._rest = rest
        normals = rest.normals if normals is None else normals
        precision = precision or ("f64" if has_f64 else "f32")
        self.resolution = 1e-9 if precision == "f64" else 1e-6
        real = np.float64 if precision == "f64" else np.float32
        # The newer LLVM of Quadrants makes vectors of a third of them only: there one vertex after
        # the other is as quick.
        is_worth_it = form.width == CUBE.width and len(rest.V) >= LANES_FROM
        has_lanes = is_worth_it and self.device == "taichi-cpu"
        self._kernels = _kernels(precision, form.width, has_lanes)
        self.precision, self.real = precision, real
        self.arrays = arrays_for(self.device)
        n = len(rest.V)
        lam = local_cubeness(rest.areas, normals, lam)
        self._options = options
        # for what the kernel does not certify; the covariances come with the positions
        all_Q = np.broadcast_to(Q, (n, 3, 3))
        nothing = np.zeros((n, 3, 3))
        self._rest_problem = LocalProblem(nothing, normals, all_Q, lam, form)
        self._normal_weight = lam * rest.areas
        self._arguments = self._make_arguments(Q)
        self._tables = ()
        if not has_lanes:
            self._tables = face_tables(form.faces, self._keep, self.arrays.keep)
        self._scatter = self._keep(rest.matrices.scatter)
        self._rhs = np.empty((n, 3), real)
        of = self._arguments
        self._of_rhs = of.indptr, of.indices, self._scatter, of.R, self._rhs
        self._rows = self._make_rows()
        self._sum_on_device = None
        self.compile_seconds = warm_up(
            [
                (
                    self._kernels.local_step,
                    (self._rhs, *vars(self._arguments).values(), *self._tables),
                ),
                (self._kernels.right_hand_side, self._of_rhs),
            ]
        )

    def _keep(self, values):
        return self.arrays.keep(np.ascontiguousarray(values, dtype=self.real))

    def _make_arguments(self, Q):
        m, rest, keep = self._rest.matrices, self._rest, self._keep
        identity = np.tile(np.eye(3), (len(rest.V), 1, 1))
        # between the positions and the `face_tables`, in the order of the kernel `local_step`
        return SimpleNamespace(
            indptr=self.arrays.keep(m.indptr),
            indices=self.arrays.keep(m.indices),
            gather=keep(m.gather),
            weights=keep(-m.laplacian),
            normals=keep(self._rest_problem.normals),
            area_scale=keep(area_scale(rest.areas)),
            lam=keep(self._rest_problem.lam),
            Q=keep(Q),
            q_stride=int(len(Q) > 1),
            R=keep(identity),
            subgradients=keep(self._rest_problem.starting(identity)),
            energies=keep(np.zeros((len(rest.V), 3))),
            certified=self.arrays.keep(np.zeros(len(rest.V), np.int32)),
        )

    def _make_rows(self):
        of = self._arguments
        outputs = of.R, of.subgradients, of.energies
        if not self.arrays.is_resident:
            return HostRows(self._rest.matrices, area_scale(self._rest.areas), *outputs)
        from .taichi_rows import DeviceRows

        edges = of.indptr, of.indices, of.gather, of.weights
        width = self._rest_problem.form.width
        return DeviceRows(self.precision, width, *edges, of.area_scale, *outputs)

    @property
    def R(self):  # noqa: N802 - as in `NumpyLocalStep`
        """(n,3,3) rotations, the identity at first."""
        return self.arrays.fetch(self._arguments.R)

    @alone
    def motion(self, setup, U, constraints=()):
        """Return the Motion that follows these rotations, from positions U (n,3)."""
        if setup.global_step.is_factorized and not self.arrays.is_resident:
            return Motion(setup, self, U, constraints)
        from .taichi_motion import TaichiMotion, motion_kernels

        keep = self.arrays.keep
        topology = setup.rest.topology
        groups, self._group_component = topology.groups
        self._sums = np.zeros((len(self._group_component), 3), self.real)
        # Taken from each vertex. Taken from their sum, which is as large as that of all squared
        # edges, the rounding of 32 bit would hide how the energy falls: momentum and end need it.
        at_rest, weight = self._keep(setup.rest.energy_terms), self._keep(self._normal_weight)
        parts = keep(np.zeros((len(topology.chunks[1]), 3), self.real))
        of_vertices = self._arguments.energies, at_rest, weight, self._arguments.certified
        arguments = keep(topology.chunks[0]), *of_vertices, keep(groups), parts, self._sums
        kernel = motion_kernels(self.precision).sum_energies
        self._sum_on_device = partial(kernel, *arguments)
        motion = TaichiMotion(setup, self, U, constraints)
        self.compile_seconds += warm_up([(kernel, arguments)]) + motion.compile_seconds
        return motion

    def start_from(self, R):
        """Begin with rotations (n,3,3)."""
        self.arrays.put(self._arguments.R, R)
        self.arrays.put(self._arguments.subgradients, self._rest_problem.starting(R))

    @alone
    def update(self, U):
        """Fit all rotations to the positions U (n,3); return energies as `NumpyLocalStep`."""
        self.start_device()
        if not self.arrays.is_resident:
            U = np.ascontiguousarray(U, dtype=self.real)
        self._kernels.local_step(U, *vars(self._arguments).values(), *self._tables)
        if self._sum_on_device is not None:
            return self._summed(U, self._sum_on_device)
        rows = self._uncertified()
        if len(rows):
            self._solve_by_admm(U, rows)
        quadratic, trace, cost = self.arrays.fetch(self._arguments.energies).T.astype(
            np.float64, copy=False
        )
        sum_parts = self._rest.topology.sum_parts
        arap = 0.75 * self._rest.edge_sums + sum_parts(0.75 * quadratic - trace)
        return arap, sum_parts(self._normal_weight * cost)

    def _summed(self, U, sum_on_device):
        """Return the energies where kernels sum them up."""
        sum_on_device()
        arap, cubic, uncertified = self._sums.T
        if uncertified.any():
            self._solve_by_admm(U, self._uncertified())
            sum_on_device()
            arap, cubic, _ = self._sums.T
        count = self._rest.topology.component_count
        return tuple(np.bincount(self._group_component, part, count) for part in (arap, cubic))

    def _uncertified(self):
        return np.flatnonzero(self.arrays.fetch(self._arguments.certified) == 0)

    def _solve_by_admm(self, U, rows):
        """Find the rotations of some rows that the kernel has left as they were."""
        S, last, last_s = self._rows.take(U, rows)
        problem = self._rest_problem.part(rows).with_covariances(S)
        R, s = admm_rotations(problem, last, last_s, self._options)
        is_worse = problem.is_worse(R, last)  # so that no iteration raises the energy
        R = np.where(is_worse[:, None, None], last, R)
        s = np.where(is_worse[:, None], last_s, s)
        fit, cost = problem.costs(R)
        self._rows.put(rows, R, s, fit * area_scale(self._rest.areas[rows]), cost)

    @alone
    def right_hand_side(self):
        """Return the right-hand side (n,3) of L U = rhs for the present rotations."""
        self.start_device()
        self._kernels.right_hand_side(*self._of_rhs)
        return self._rhs.astype(np.float64, copy=False)

    def start_device(self):
        """Make sure that kernels can run: another add-on may have reset the engine.

        Raises CubicCraftError: it has, and the arrays were on the device.
        """
        self.arrays.check()
        taichi_runtime.start(self._wanted)

    def residual_arguments(self, point, scale, B):
        """Return what the kernel `residual` of `taichi_motion_kernels.py` is called with."""
        of = self._arguments
        return of.indptr, of.indices, self._scatter, of.weights, of.R, point, scale, B


class HostRows:
    """The rows of a local step that its kernel leaves to another method, of arrays in NumPy.

    `taichi_rows.py` has the same for those on a device.

    `matrices`: SpokesAndRims. `area_scale`: (n,). `R`, `s`, `energies`: (n,3,3), (n,w) and (n,3),
    rotations, states, and the energies of `local_step` in `taichi_kernels.py`.
    """

    def __init__(self, matrices, area_scale, R, s, energies):
        self._matrices, self._area_scale = matrices, area_scale
        self._R, self._s, self._energies = R, s, energies

    def take(self, U, rows):
        """Return divided covariances (k,3,3), rotations (k,3,3) and states (k,w) of rows.

        `U`: (n,3), positions. `rows`: (k,) int.
        """
        S = self._matrices.covariances(U.astype(np.float64, copy=False), rows)
        S = S / self._area_scale[rows, None, None]
        return S, self._R[rows].astype(np.float64), self._s[rows]

    def put(self, rows, R, s, fit, cost):
        """Set rotations (k,3,3) and states (k,w), and their fit (k,) and cost (k,)."""
        self._R[rows], self._s[rows] = R, s
        self._energies[rows, 1:] = np.stack([fit, cost], axis=1)


@cache
def _kernels(precision, width, has_lanes):
    from .engine import ti
    from .taichi_kernels import make_kernels

    return make_kernels(ti.f64 if precision == "f64" else ti.f32, width, has_lanes)
