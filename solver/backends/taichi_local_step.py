# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step in Taichi, on the CPU or a GPU. See `NumpyLocalStep` for the interface."""

import time
from functools import cache, partial

import numpy as np

from ..active_set import starting_signs
from ..admm import admm_rotations
from ..errors import CubicCraftError
from ..local_problem import LocalProblem
from ..motion import Motion
from . import taichi_runtime
from .numpy_local_step import area_scale, local_cubeness
from .rehearsal import rehearse


class TaichiLocalStep:
    """Rotations from positions, and the right-hand side of the global step from rotations.

    Parameters
    ----------
    rest, lam, Q, options
        As in `NumpyLocalStep`.
    device : {"cpu", "gpu"}
    precision : {"f64", "f32"}, optional
        By default f64 where the device has it.

    Attributes
    ----------
    device : str
        Such as "taichi-cpu".
    resolution : float
        As in `NumpyLocalStep`.
    precision, real : str and dtype
        The precision, "f64" or "f32", and NumPy's type for it.
    compile_seconds : float
        Time spent compiling the kernels or loading them from Taichi's cache; 0 after the first use.
    """

    def __init__(self, rest, lam, Q, options, device="cpu", precision=None):
        runtime = taichi_runtime.start(device)
        self._rest = rest
        self._wanted, self.device = device, runtime.device
        precision = precision or ("f64" if runtime.has_f64 else "f32")
        if precision not in ("f64", "f32"):
            raise CubicCraftError(f"the precision must be f64 or f32, not {precision!r}")
        self.resolution = 1e-9 if precision == "f64" else 1e-6
        real = np.float64 if precision == "f64" else np.float32
        self._kernels = _kernels(precision)
        self.precision, self.real = precision, real
        m = rest.matrices
        n = len(rest.V)

        def array(values):
            return np.ascontiguousarray(values, dtype=real)

        self._weights = array(-m.laplacian)
        self._gather, self._scatter = array(m.gather), array(m.scatter)
        self._normals = array(rest.normals)
        lam = local_cubeness(rest, lam)
        self._lam, self._Q = array(lam), array(Q)
        self._options = options
        self._area_scale = array(area_scale(rest.areas))
        self._cubic_weight = lam * rest.areas
        self._rest_quadratic = 0.75 * rest.edge_sums
        self.R = np.tile(np.eye(3, dtype=real), (n, 1, 1))
        Q = np.broadcast_to(Q, (n, 3, 3))
        # for what the kernel does not certify; the covariances come with the positions
        self._rest_problem = LocalProblem(np.zeros((n, 3, 3)), rest.normals, Q, lam)
        self._s = array(starting_signs(self._rest_problem.cube_normals(self.R)))
        self._certified = np.empty(n, np.int32)
        self._energies = np.empty((n, 3), real)
        self._rhs = np.empty((n, 3), real)
        self._arguments = (
            m.indptr,
            m.indices,
            self._gather,
            self._weights,
            self._normals,
            self._area_scale,
            self._lam,
            self._Q,
            int(len(self._Q) > 1),
            self.R,
            self._s,
            self._energies,
            self._certified,
        )
        self._sum_on_device = None
        self.compile_seconds = _compile(self._kernels, self._arguments, precision)

    def motion(self, setup, U):
        """Return the Motion that follows these rotations, from positions U (n,3)."""
        if setup.global_step.multigrid is None:
            return Motion(setup, self, U)
        from .taichi_motion import TaichiMotion, motion_kernels

        bounds, self._chunk_component = setup.rest.chunks
        self._sums = np.empty((len(self._chunk_component), 3), self.real)
        weight = self._cubic_weight.astype(self.real)
        arguments = (bounds, self._energies, weight, self._certified, self._sums)
        kernel = motion_kernels(self.precision).sum_energies
        self._sum_on_device = partial(kernel, *arguments)
        motion = TaichiMotion(setup, self, U)
        self.compile_seconds += rehearse([(kernel, arguments)]) + motion.compile_seconds
        return motion

    def start_from(self, R):
        """Begin with rotations (n,3,3)."""
        self.R[:] = R
        self._s[:] = starting_signs(self._rest_problem.cube_normals(R))

    def update(self, U):
        """Fit all rotations to the positions U (n,3); return energies as `NumpyLocalStep`."""
        taichi_runtime.start(self._wanted)  # another add-on may have reset it since
        U = np.ascontiguousarray(U, dtype=self.real)
        self._kernels.local_step(U, *self._arguments)
        if self._sum_on_device is not None:
            return self._summed(U, self._sum_on_device)
        rows = np.flatnonzero(self._certified == 0)
        if len(rows):
            self._solve_by_admm(U, rows)
        quadratic, trace, l1 = self._energies.T.astype(np.float64)
        arap = self._rest_quadratic + self._rest.sum_parts(0.75 * quadratic - trace)
        return arap, self._rest.sum_parts(self._cubic_weight * l1)

    def _summed(self, U, sum_on_device):
        """Return the energies of a large mesh."""
        sum_on_device()
        if self._sums[:, 2].any():
            self._solve_by_admm(U, np.flatnonzero(self._certified == 0))
            sum_on_device()
        arap, cubic, _ = self._sums.T.astype(np.float64)
        count = self._rest.component_count
        arap = self._rest_quadratic + np.bincount(self._chunk_component, arap, count)
        return arap, np.bincount(self._chunk_component, cubic, count)

    def _solve_by_admm(self, U, rows):
        """Find the rotations of some rows that the kernel has left as they were."""
        areas = area_scale(self._rest.areas)[rows, None, None]
        S = self._rest.matrices.covariances(U.astype(np.float64, copy=False), rows) / areas
        problem = self._rest_problem.part(rows)._replace(S=S)
        last = self.R[rows].astype(np.float64)
        R, s = admm_rotations(problem, last, self._s[rows], self._options)
        is_worse = problem.is_worse(R, last)  # so that no iteration raises the energy
        self.R[rows] = R = np.where(is_worse[:, None, None], last, R)
        self._s[rows] = np.where(is_worse[:, None], self._s[rows], s)
        fit, self._energies[rows, 2] = problem.costs(R)
        self._energies[rows, 1] = fit * areas[:, 0, 0]

    def right_hand_side(self):
        """Return the right-hand side (n,3) of L U = rhs for the present rotations."""
        taichi_runtime.start(self._wanted)
        self._kernels.right_hand_side(*self._arguments[:2], self._scatter, self.R, self._rhs)
        return self._rhs.astype(np.float64, copy=False)

    def start_device(self):
        """Make sure that kernels can run: another add-on may have reset Taichi."""
        taichi_runtime.start(self._wanted)

    def residual_arguments(self, point, scale, B):
        """Return what the kernel `residual` of `taichi_motion_kernels.py` is called with."""
        indptr, indices, _, weights = self._arguments[:4]
        return indptr, indices, self._scatter, weights, self.R, point, scale, B


@cache
def _kernels(precision):
    from .taichi_kernels import make_kernels

    ti = taichi_runtime.import_taichi()
    return make_kernels(ti.f64 if precision == "f64" else ti.f32)


_compiled = set()


def _compile(kernels, arguments, precision):
    """Run the kernels on a single vertex if that has not been done yet; return the seconds."""
    if precision in _compiled:
        return 0.0
    begin = time.perf_counter()
    first = [a[:1].copy() if isinstance(a, np.ndarray) else a for a in arguments]
    no_entries = np.zeros(2, np.int32)
    point = np.zeros_like(first[4])
    kernels.local_step(point, no_entries, *first[1:])
    kernels.right_hand_side(no_entries, first[1], first[2], first[9], point)
    _compiled.add(precision)
    return time.perf_counter() - begin
