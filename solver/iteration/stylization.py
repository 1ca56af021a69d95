# SPDX-License-Identifier: GPL-3.0-or-later
"""The local-global iteration on one mesh, step by step."""

from __future__ import annotations

import math
from copy import copy
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import FloatArray
from ..backends import local_step_class
from ..coarse_to_fine.start import coarser_pose, coarser_style
from ..contacts.riding import Riding
from ..global_step.holds import Holds
from ..inputs import instance, real_numbers
from ..styles.admm import AdmmOptions
from ..styles.polytope_step import polytopes
from ..styles.solved_style import SolvedStyle, solved_style
from ..styles.style import Style
from ..surface.symmetry import Mirror
from ..values import Stored, described
from .acceleration import Momentum
from .options import SolverOptions
from .pose import Pose, pins_moved
from .result import Energy
from .setup import Setup

_FIRST_SOLVES = 3  # where a solve is approximate, the first one starts far from the solution


class Stylization(Stored):
    """The state of one run: call `step` repeatedly and read `positions`.

    A pickled one continues from its shape when it is unpickled, without its momentum.

    Parameters
    ----------
    setup : Setup
    style : Style, or float or (N,) numpy array
        What the vertices of the input are turned toward, and how strongly. Numbers are the cubeness
        of cubes along the axes.
    pose : Pose, optional
        Where pinned vertices and held groups go; by default they stay.
    options : SolverOptions, optional

    Attributes
    ----------
    is_coarse : bool
        Whether the mesh is a coarser one that provides the start for another, see `coarser`.
    is_started : bool
        Whether it has begun elsewhere than at rest.
    is_limited : bool
        Whether it is solved with less than its cubeness for now, see `limit_cubeness`.
    iterations : int
        Number of steps done.
    energy : Energy or None
        At the point used by the last local step; after `finish`, that of the result.
    displacement, distance : float
        Largest displacement in the last step and largest distance from rest, in the unit box.

    Raises
    ------
    CubicCraftError
        The style or the pose does not fit the setup, a value is invalid, or the device is not
        available.

    Notes
    -----
    The steps are those of Liu and Jacobson, "Cubic Stylization", ACM Transactions on Graphics
    38(6), 2019; `active_set` and `acceleration` describe the differences.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Setup, SolverOptions, Stylization, ball, rest_mesh
    >>> V, F = ball()
    >>> setup = Setup(rest_mesh(V, F))
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> stylization = Stylization(setup, 0.6, options=options)
    >>> for _ in range(3):
    ...     stylization.step()
    ...     print(f"energy {stylization.energy.total:.2f}, moved {stylization.distance:.2f}")
    energy 4.68, moved 0.04
    energy 4.34, moved 0.09
    energy 4.19, moved 0.12
    """

    # what lies on the device: it is made anew from the positions and rotations
    _made_anew = ("_local", "_motion", "_constraints", "_acceleration")

    def __init__(
        self,
        setup: Setup,
        style: Style | ArrayLike,
        pose: Pose | None = None,
        options: SolverOptions | None = None,
    ):
        instance(setup, "setup", Setup)
        style = style if isinstance(style, Style) else Style(style)
        pose = Pose() if pose is None else instance(pose, "pose", Pose)
        options = SolverOptions() if options is None else options
        self.options = instance(options, "options", SolverOptions)
        self.is_coarse = False
        keep_rotation = options.keep_rotation
        self._style = solved_style(style, setup, pose.limbs, keep_rotation=keep_rotation)
        self._begin_at_rest(setup, pose)

    def _begin_at_rest(self, setup: Setup, pose: Pose) -> None:
        """Make both steps for a setup at rest, but for its pins, which are where the pose has them.

        The limbs of the pose have been followed by the style.
        """
        self._targets, self._hold_matrices = pose.targets_of(setup), pose.hold_matrices
        U = setup.rest.V.copy()
        U[setup.pinned] += pins_moved(setup, self._targets) / setup.rest.box.size
        self._begin(setup, U)
        self.is_started = False
        self.iterations = 0
        self.energy: Energy | None = None
        self.displacement = self.distance = 0.0

    def _begin(
        self,
        setup: Setup,
        U: FloatArray,
        R: FloatArray | None = None,
        most_cubeness: float = math.inf,
    ) -> None:
        """Make both steps for a setup, from positions U (n,3) and rotations R (n,3,3)."""
        self.setup, self.rest = setup, setup.rest
        self.is_limited = most_cubeness < math.inf
        self._local = self._local_step_of(setup.rest, most_cubeness)
        self._constraints = self._constraints_of(setup)
        self._motion = self._local.motion(setup, U, self._constraints)
        self._acceleration = self._momentum()
        self._riding: Riding | None = None
        if R is not None:
            self._local.start_from(R)

    def _constraints_of(self, setup: Setup) -> list[Mirror | Holds]:
        fields = setup.hold_fields
        held = [] if fields is None else [Holds(fields, self._hold_matrices)]
        return [*held, *setup.mirrors]

    def _local_step_of(self, rest, most_cubeness):
        style, options = self._style, self.options
        return local_step_class(options.device, options.precision)(
            rest,
            style.limited(most_cubeness) if self.is_limited else style.lam,
            style.Q,
            options.admm or AdmmOptions(),
            polytopes(style.forms, style.form_of),
            style.normals,
        )

    def __getstate__(self) -> dict[str, Any]:
        state = super().__getstate__()
        return {**state, "positions": self._motion.positions, "rotations": self._local.R}

    def __setstate__(self, state: dict[str, Any]) -> None:
        U, R = state.pop("positions"), state.pop("rotations")
        self.__dict__.update(state)
        self._begin(self.setup, U.copy(), R)

    def __repr__(self) -> str:
        values = [("setup", self.setup), ("iterations", self.iterations), ("energy", self.energy)]
        return described(Stylization, [*values, ("device", self.device)])

    def continued(self, setup: Setup) -> Stylization:
        """Return a Stylization that goes on from here, with another setup of the same vertices."""
        other = copy(self)
        other._begin(setup, self.positions.copy(), self.rotations.copy())
        other.is_started = True
        still = np.zeros(other.rest.topology.component_count)
        for _ in range(_FIRST_SOLVES):
            other._motion.step(still, still, other.options.keep_rotation)
        return other

    def go_on_from(self, other: Stylization, setup: Setup) -> None:
        """Go on from where another one is, of the same vertices.

        `setup`: of the style and the pose of this one, and maybe with further links.
        """
        U = other.positions.copy()
        U[setup.pinned] = self.positions[setup.pinned]
        self._begin(setup, U, other.rotations.copy())
        self.is_started = True

    def with_riding(self, riding: Riding) -> Stylization:
        """Return one at the same point, its end, in which some vertices ride on others."""
        other = copy(self)
        other._riding = riding
        return other

    def moved(self, setup: Setup, pose: Pose | None = None) -> Stylization:
        """Return a Stylization that goes on from here with another rest shape.

        It begins with the present shape, in which each component is shifted as at rest, and each
        vertex moved as beside that, turned by its rotation. It needs few steps if the rest shape
        has hardly changed. Weights, limbs and how much normals count stay as they are, so the end
        is only near that of a new run. `setup`: of `Setup.posed`. `pose`: its limbs are not looked
        at.

        Raises CubicCraftError: the pose does not fit the setup.
        """
        before, after = self.rest, setup.rest
        pose = Pose() if pose is None else instance(pose, "pose", Pose)
        other = copy(self)
        other._style = self._style.posed(before, after)
        other._targets, other._hold_matrices = pose.targets_of(setup), pose.hold_matrices
        R = self.rotations.copy()
        moved = after.V - before.V
        shift = after.topology.means(moved, before.areas)
        U = self.positions + shift + np.einsum("nij,nj->ni", R, moved - shift)
        held = setup.pinned
        U[held] = after.V[held] + pins_moved(setup, other._targets) / after.box.size
        other._begin(setup, U, R)
        other.is_started = True
        other.iterations, other.energy = 0, None
        return other

    def coarser(self) -> Stylization:
        """Return a new Stylization of the coarser mesh of the setup, which must have one."""
        setup, other = self.setup.coarse, copy(self)
        assert setup is not None
        other.is_coarse = True
        other.options = replace(self.options, keep_rotation=True)
        other._style = coarser_style(self._style, self.setup)
        pose = coarser_pose(self.setup, self.positions, self._hold_matrices)
        other._begin_at_rest(setup, pose)
        return other

    def limit_cubeness(self, most: float) -> None:
        """Go on from here with a cubeness of at most so much, without momentum."""
        spent = self.compile_seconds
        self._begin(self.setup, self.positions.copy(), self.rotations.copy(), most)
        self._local.compile_seconds += spent

    def impose(self, U: FloatArray) -> None:
        """Move positions (n,3) in the unit box so that mirrors and held groups are obeyed."""
        for constraint in self._constraints:
            constraint.impose(U)

    def go_to(self, R: FloatArray, U: FloatArray) -> None:
        """Go to rotations (n,3,3) and positions (n,3) in the unit box, as they are."""
        self._local.start_from(R)
        self._motion.put(U)
        self._acceleration = self._momentum()

    @property
    def device(self) -> str:
        """Name of the device that runs the local step, such as "taichi-cpu"."""
        return self._local.device

    @property
    def resolution(self) -> float:
        """Distance in the unit box below which differences are rounding errors."""
        return self._local.resolution

    @property
    def compile_seconds(self) -> float:
        """Seconds spent compiling kernels or loading them from a cache."""
        return self._local.compile_seconds

    @property
    def positions(self) -> FloatArray:
        """(n,3) current positions in the unit box, of the vertices of `rest`."""
        return self._shape() if self._riding is None else self.current()[1]

    @property
    def rotations(self) -> FloatArray:
        """(n,3,3) rotations of the last local step, of the vertices of `rest`."""
        R = self._turns()
        return R if self._riding is None else self._riding.turned(R)

    def current(self) -> tuple[FloatArray, FloatArray]:
        """Return both: rotations of what rides, which take long, are found once."""
        R, U = self.rotations, self._shape()
        return R, U if self._riding is None else self._riding.carried(U, R)

    def _shape(self) -> FloatArray:
        return self._motion.positions

    def _turns(self) -> FloatArray:
        return self._local.R

    @property
    def style(self) -> SolvedStyle:
        """The Style at the vertices of `rest`."""
        return self._style

    def _momentum(self):
        return Momentum(self.rest.topology.component_count) if self.options.is_accelerated else None

    def start_from(self, R: FloatArray, near: FloatArray) -> None:
        """Start the iteration anew, from rotations (n,3,3) and positions (n,3) in the unit box."""
        self.is_started, self._acceleration = True, self._momentum()
        self._local.start_from(R)
        near[self.setup.pinned] = self.positions[self.setup.pinned]
        self._motion.put(near)
        self._motion.relax(_FIRST_SOLVES)

    def step(self) -> None:
        """Do one local and one global step."""
        self.local_step()
        self.global_step()

    def local_step(self) -> None:
        """Fit the rotations to the positions."""
        arap, cubic = self._local.update(self._motion.point)
        if self._acceleration is not None:
            self._acceleration.observe(arap + cubic)
        self.energy = Energy(float(arap.sum()), float(cubic.sum()))

    def global_step(self) -> None:
        """Move the positions toward the rotations of the previous local step."""
        if self._acceleration is None:
            momentum = overshoot = np.zeros(self.rest.topology.component_count)
        else:
            momentum, overshoot = self._acceleration.next()
        self.displacement, self.distance = self._motion.step(
            momentum, overshoot, self.options.keep_rotation
        )
        self.iterations += 1

    def finish(self) -> Energy:
        """Fit the rotations to the last positions and return the Energy of both."""
        self._motion.look_at_positions()
        self.local_step()
        assert self.energy is not None  # the local step has set it
        return self.energy

    def energy_of(self, positions: ArrayLike, steps: int = 20) -> Energy:
        """Return the Energy of a given shape (N,3), which replaces the state of the run.

        With rotations that fit it: the best of as many local steps, each of which starts from those
        of the step before.
        """
        solved = self.rest.input_map.spread(real_numbers(positions, "positions"))
        self._motion.put(self.rest.box.to_unit(solved))
        return min((self.finish() for _ in range(steps)), key=lambda energy: energy.total)

    def placed(
        self, R: FloatArray | None = None, U: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Return positions (N,3) in the units of the input and rotations (N,3,3).

        They are those of the current state, or of given rotations (n,3,3) and positions (n,3) in
        the unit box. Loose vertices have exactly their given positions, pinned ones their targets.
        """
        rotations = np.tile(np.eye(3), (len(self.rest.input_positions), 1, 1))
        used, place = self.rest.place
        rotations[used] = (self.rotations if R is None else R)[place]
        return self.placed_positions(U), rotations

    def placed_positions(self, U: FloatArray | None = None) -> FloatArray:
        """Return only the positions, to show them while it runs."""
        rest = self.rest
        positions = rest.input_positions.copy()
        used, place = rest.place
        positions[used] = rest.box.from_unit(self.positions if U is None else U)[place]
        held = self.setup.pinned_input
        positions[held] = self._targets[held]
        return positions
