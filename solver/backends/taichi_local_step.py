# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step in Taichi, on the CPU or a GPU. See `NumpyLocalStep` for the interface."""

import time
from functools import cache

import numpy as np

from ..errors import CubicCraftError
from . import taichi_runtime
from .numpy_local_step import area_scale, local_cubeness


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
        # what is smaller is rounding, and would be waited for in vain
        least_absolute, least_relative = (0.0, 0.0) if precision == "f64" else (1e-5, 1e-3)
        self._kernels = _kernels(precision)
        self._real = real
        m = rest.matrices
        n = len(rest.V)

        def array(values):
            return np.ascontiguousarray(values, dtype=real)

        self._weights = array(-m.laplacian)
        self._gather, self._scatter = array(m.gather), array(m.scatter)
        self._normals = array(rest.normals)
        lam = local_cubeness(rest, lam)
        self._lam, self._Q = array(lam), array(Q)
        self._area_scale = array(area_scale(rest.areas))
        self._cubic_weight = lam * rest.areas
        self._rest_quadratic = 0.75 * rest.edge_sums
        self.R = np.tile(np.eye(3, dtype=real), (n, 1, 1))
        self._z = array(np.einsum("nij,nj->ni", np.broadcast_to(Q, (n, 3, 3)), rest.normals))
        self._u = np.zeros((n, 3), real)
        self._rho = np.full(n, options.rho_start, real)
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
            options.max_iterations,
            max(options.absolute, least_absolute),
            max(options.relative, least_relative),
            options.rho_min,
            options.rho_max,
            options.balance,
            options.factor,
            self.R,
            self._z,
            self._u,
            self._rho,
            self._energies,
        )
        self.compile_seconds = _compile(self._kernels, self._arguments, precision)

    def start_from(self, R):
        """Begin with rotations (n,3,3)."""
        self.R[:] = R
        Q = np.broadcast_to(self._Q, self.R.shape)
        self._z[:] = np.einsum("nij,njk,nk->ni", Q, R, self._rest.normals)

    def update(self, U):
        """Fit all rotations to the positions U (n,3); return energies as `NumpyLocalStep`."""
        taichi_runtime.start(self._wanted)  # another add-on may have reset it since
        U = np.ascontiguousarray(U, dtype=self._real)
        self._kernels.local_step(U, *self._arguments)
        quadratic, trace, l1 = self._energies.T.astype(np.float64)
        arap = self._rest_quadratic + self._rest.sum_parts(0.75 * quadratic - trace)
        return arap, self._rest.sum_parts(self._cubic_weight * l1)

    def right_hand_side(self):
        """Return the right-hand side (n,3) of L U = rhs for the present rotations."""
        taichi_runtime.start(self._wanted)
        self._kernels.right_hand_side(*self._arguments[:2], self._scatter, self.R, self._rhs)
        return self._rhs.astype(np.float64, copy=False)


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
    kernels.right_hand_side(no_entries, first[1], first[2], first[16], point)
    _compiled.add(precision)
    return time.perf_counter() - begin
