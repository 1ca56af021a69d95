# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole run in one call: mesh in, cubic mesh out."""

import time
from dataclasses import dataclass

import numpy as np

from .coarse_start import MAX_ITERATIONS, TOLERANCE, coarse_stylization, preview_on_fine, prolongate
from .errors import CubicCraftError
from .proxy import PAPER
from .rest import rest_mesh
from .setup import Setup
from .stop_rule import StopRule
from .stylization import Energy, Stylization


@dataclass(frozen=True)
class Result:
    """A finished run."""

    positions: np.ndarray
    """(n,3) float64, in the unit of the input"""
    rotations: np.ndarray
    """(n,3,3) float64 rotation of each vertex; the identity for loose vertices"""
    energy: Energy
    """of the result, in the unit box"""
    iterations: int
    reason: str
    """"converged", "max_iterations" or "cancelled" """
    device: str
    compile_seconds: float
    solve_seconds: float

    @property
    def converged(self):
        """Whether the stop rule ended the run."""
        return self.reason == "converged"


def stylize(
    V,
    F,
    cubeness=0.4,
    pinned=(),
    *,
    max_iterations=1000,
    tolerance=1e-3,
    on_iteration=None,
    proxy=PAPER,
    **options,
):
    """Return the cubic version of a mesh (Liu and Jacobson, "Cubic Stylization", 2019).

    Parameters
    ----------
    V : (n,3) array_like of float
        Rest positions, in any unit. Vertices in no triangle stay where they are.
    F : (m,3) array_like of int
        Triangles.
    cubeness : float or (n,) array_like
        0 keeps the shape; 0.1 to 1 are common.
    pinned : (k,) array_like of int
        Vertices held exactly in place.
    max_iterations : int
        See `run`, also for the next two.
    tolerance : float
    on_iteration : callable, optional
    proxy : ProxyOptions
        How the surface is prepared: welded, refined, linked to its neighbours and its other side.
        By default not at all, as in the paper; ``ProxyOptions()`` is what artists get.
    **options
        See `Stylization`: orientation, targets, device, precision, keep_rotation and more.

    Returns
    -------
    Result

    Raises
    ------
    CubicCraftError
        The mesh or an option cannot be used; the message says why.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import stylize
    >>> V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    >>> stylize(V, F, 0.4, device="numpy").converged
    True
    """
    stylization = Stylization(Setup(rest_mesh(V, F, proxy), pinned), cubeness, **options)
    return run(stylization, max_iterations, tolerance, on_iteration)


def run(stylization, max_iterations=1000, tolerance=1e-3, on_iteration=None):
    """Iterate a fresh Stylization to its end.

    Parameters
    ----------
    stylization : Stylization
    max_iterations : int
    tolerance : float
        See `StopRule`.
    on_iteration : callable, optional
        Called with the Stylization after each iteration; a true value cancels the run.

    Returns
    -------
    Result

    Raises
    ------
    CubicCraftError
        The tolerance is not positive, or there is no iteration to do.
    """
    run = Run(stylization, max_iterations, tolerance)
    run.complete(on_iteration)
    return run.result()


class Run:
    """A run that is advanced phase by phase, for those who have something else to do in between.

    However it is sliced, the result is that of `run`, bit for bit.

    Parameters
    ----------
    stylization : Stylization
        As in `run`, and so are the next two.
    max_iterations : int
    tolerance : float

    Attributes
    ----------
    reason : str or None
        None while there is more to do, then as in `Result`.

    Raises
    ------
    CubicCraftError
        As `run`.
    """

    def __init__(self, stylization, max_iterations=1000, tolerance=1e-3):
        if not (np.isfinite(tolerance) and tolerance > 0.0):
            raise CubicCraftError(f"tolerance must be finite and positive, not {tolerance}")
        if not max_iterations >= 1:
            raise CubicCraftError(f"max_iterations must be at least 1, not {max_iterations}")
        self.stylization = stylization
        self.reason = None
        self._max_iterations = max_iterations
        self._rule = StopRule(tolerance, stylization.resolution)
        self._is_local_next = True
        self._seconds = 0.0
        self._coarse_iterations = 0
        coarse = coarse_stylization(stylization)
        self._coarse = None if coarse is None else Run(coarse, MAX_ITERATIONS, TOLERANCE)

    @property
    def is_on_coarser_mesh(self):
        """Whether it has yet to begin on the mesh itself."""
        return self._coarse is not None

    @property
    def iterations(self):
        """Number of iterations done, those on coarser meshes included."""
        coarse = self._coarse_iterations if self._coarse is None else self._coarse.iterations
        return coarse + self.stylization.iteration

    def advance(self):
        """Do one phase: a local or a global step. At the end, `reason` is set."""
        begin = time.perf_counter()
        if self._coarse is not None:
            self._advance_coarse()
        else:
            self._advance_fine()
        self._seconds += time.perf_counter() - begin

    def _advance_coarse(self):
        self._coarse.advance()
        if self._coarse.reason is not None:
            prolongate(self._coarse.stylization, self.stylization)
            self._coarse_iterations = self._coarse.iterations
            self._coarse = None

    def _advance_fine(self):
        state = self.stylization
        if self._is_local_next:
            state.local_step()
        else:
            state.global_step()
            if self._rule.is_converged(state.energy.total, state.displacement, state.distance):
                self.reason = "converged"
            elif state.iteration >= self._max_iterations:
                self.reason = "max_iterations"
        self._is_local_next = not self._is_local_next

    def complete(self, on_iteration=None):
        """Advance to the end; `on_iteration` as in `run`."""
        while self.reason is None:
            before = self.stylization.iteration
            self.advance()
            is_new = self.stylization.iteration > before
            if is_new and on_iteration is not None and on_iteration(self.stylization):
                self.reason = "cancelled"

    def positions(self):
        """Return the positions (n,3) as they are now, in the unit of the input.

        While it starts on a coarser mesh they are those of its vertices, with the details at rest.
        """
        return self.stylization.placed_positions(self._glance()[1])

    def placed(self):
        """Return the positions (n,3) and the rotations (n,3,3) as they are now."""
        return self.stylization.placed(*self._glance())

    def _glance(self):
        """Return the rotations and the positions in the unit box as they are now."""
        state = self.stylization
        if self._coarse is None:
            return state.rotations, state.positions
        positions, R = self._coarse.placed()
        return preview_on_fine(positions, R, state.rest)

    def result(self):
        """Return the Result of what has been done; the iteration cannot go on after it."""
        begin = time.perf_counter()
        state = self.stylization
        energy = state.finish()
        positions, rotations = self.placed()
        seconds = self._seconds + time.perf_counter() - begin
        return Result(
            positions,
            rotations,
            energy,
            state.iteration,
            self.reason or "cancelled",
            state.device,
            state.compile_seconds,
            seconds,
        )
