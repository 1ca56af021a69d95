# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames of an animation, each solved from the end of the one before.

The energy has many minima. Solved from rest, two frames that hardly differ can end in different
ones, and the surface jumps. So each frame begins where the one before has ended, moved along with
the surface: with the rotation T_i of the surroundings of a vertex from pose v to pose v',

    u'_i = v'_i + T_i (u_i - v_i),    R'_i = T_i R_i T_i'

with a share f dropped, that is with (1 - f)(u_i - v_i) and the rotation between R_i and the
identity. What is never dropped accumulates: a thin coat that turns to and fro is left with a
pleat where its corners were, and a sheet that falls over a ball stays flat.

Even so, a minimum can vanish, and the shape then falls into the next one; `steadiness` spreads that
over several frames. A few steps for each frame are nearly enough to converge, as they begin near
the end. They cost little: the factorization is that of the first pose, see `RestMesh.posed`.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..aliases import FloatArray
from ..hardening.hardening import is_hardened
from ..iteration.result import Result
from ..iteration.runner import Run
from ..iteration.stylization import Stylization
from ..rotation_fit import fit_rotations, orthonormalize
from ..surface.rest import RestMesh
from ..values import described, is_same

STEPS = 12
"""for each frame but the first"""
FORGOTTEN = 0.85
"""f. With much less, a cloth over a ball does not hang as far as it would alone, and with 1, large
meshes have more energy; see `docs/benchmarks_explained.md`."""
SETTLING = 3
"""How often the first frame is solved like all others, from itself, so that it is like them."""
_ORTHONORMALIZATIONS = 4


class SequenceState(NamedTuple):
    """The end of a frame, from which the next one of a `FrameSequence` begins.

    Examples
    --------
    A sequence that was stopped continues from its state:

    >>> import numpy as np
    >>> from solver import FrameSequence, Setup, SolverOptions, Stylization, ball, rest_mesh
    >>> V, F = ball()
    >>> setup = Setup(rest_mesh(V, F))
    >>> stopped = FrameSequence(setup.rest)
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> first = stopped.solve(Stylization(setup, 0.6, options=options))
    >>> pose = setup.posed(V * [1, 1, 1.1])
    >>> frame = Stylization(pose, 0.6, options=options)
    >>> second = FrameSequence(setup.rest, stopped.state).solve(frame)
    >>> second.iterations, round(float(np.abs(second.positions - first.positions).max()), 2)
    (12, 0.11)
    """

    pose: FloatArray
    """(n,3) rest positions of that frame in the unit box"""
    turns: FloatArray
    """(n,3,3) rotations of the surroundings of the vertices, from the first frame to this"""
    positions: FloatArray
    """(n,3) the result in the unit box"""
    rotations: FloatArray
    """(n,3,3)"""
    facing: FloatArray = np.empty((0, 3))
    """(m,3) what triangles faced, see `hardening`; empty if none were made flat"""

    def __eq__(self, other: object) -> bool:
        return type(other) is SequenceState and all(map(is_same, self, other))

    def __ne__(self, other: object) -> bool:
        return not self == other  # a tuple's own would compare arrays

    def __repr__(self) -> str:
        return described(SequenceState, self._asdict().items())


class FrameSequence:
    """Frames that are solved one after the other.

    Parameters
    ----------
    first : RestMesh
        The mesh in the first frame.
    state : SequenceState, optional
        Of an earlier sequence from the same first frame, which continues.

    Examples
    --------
    A ball that is drawn out by a tenth, frame by frame, and how far its cubic version moves:

    >>> import numpy as np
    >>> from solver import FrameSequence, Setup, SolverOptions, Stylization, ball, rest_mesh
    >>> V, F = ball()
    >>> setup = Setup(rest_mesh(V, F))
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> sequence, shown = FrameSequence(setup.rest), []
    >>> for height in (1.0, 1.05, 1.1):
    ...     frame = Stylization(setup.posed(V * [1, 1, height]), 0.6, options=options)
    ...     shown.append(sequence.solve(frame).positions)
    >>> [f"{np.linalg.norm(b - a, axis=1).max():.2f}" for a, b in zip(shown, shown[1:])]
    ['0.06', '0.05']
    """

    def __init__(self, first: RestMesh, state: SequenceState | None = None):
        self._first = first
        self.state = state  # the last frame that was solved

    @property
    def turns(self) -> FloatArray:
        """(N,3,3) rotations of the surroundings of the input's vertices since the first frame."""
        assert self.state is not None
        turns = np.tile(np.eye(3), (len(self._first.input_positions), 1, 1))
        used, place = self._first.place
        turns[used] = self.state.turns[place]
        return turns

    def solve(
        self, stylization: Stylization, max_iterations: int = 1000, tolerance: float = 1e-3
    ) -> Result:
        """Solve the next frame; `begin`, `settle` and `end` in one.

        After the first frame, the reason is "max_iterations", or "converged" if nothing moved.
        """
        run = self.begin(stylization, max_iterations, tolerance)
        run.complete()
        for _ in self.settle(run):
            pass
        return self.end(run)

    def begin(
        self, stylization: Stylization, max_iterations: int = 1000, tolerance: float = 1e-3
    ) -> Run:
        """Return the Run of the next frame, which the caller advances to its end.

        Parameters
        ----------
        stylization : Stylization
            A new one, of the first mesh or a pose of it.
        max_iterations, tolerance
            Of the first frame, as for `Run`.

        Raises
        ------
        CubicCraftError
            As `Run`.
        """
        self._turns = np.tile(np.eye(3), (len(stylization.rest.V), 1, 1))
        if self.state is not None:
            self._turns, max_iterations = self._start(stylization), STEPS
        return Run(stylization, max_iterations, tolerance, keep_apart=False, harden=False)

    def settle(self, run: Run) -> Iterator[None]:
        """Make the first frame, once it is solved, like all others; yield after each step.

        Then the sides of each frame become flat: those that triangles had in the frame before, as
        far as that is still near.
        """
        stylization = run.stylization
        if self.state is None:
            for _ in range(SETTLING):
                R, positions = _partly_forgotten(self._state_of(run))
                stylization.start_from(R, positions)
                for _ in range(STEPS):
                    stylization.step()
                    yield
        if is_hardened(stylization):
            before = self.state.facing if self.state is not None else None
            run.harden(before if before is not None and len(before) else None)
            while run.reason is None:
                yield
                run.advance()

    def end(self, run: Run) -> Result:
        """Return the Result of a frame, from which the next one begins."""
        result = run.result()
        self.state = self._state_of(run)
        return result

    def _state_of(self, run):
        soft, hard = run.soft, run.hard
        facing = np.empty((0, 3)) if hard is None else hard.hardening.facing
        state = soft.positions.copy(), soft.rotations.copy(), facing
        return SequenceState(soft.rest.V, self._turns, *state)

    def _start(self, stylization):
        """Start from the frame before; return the turns of this one."""
        before, V = self.state, stylization.rest.V
        assert before is not None
        turns = fit_rotations(self._first.matrices.covariances(V), before.turns)
        T = turns @ before.turns.swapaxes(1, 2)
        R, positions = _partly_forgotten(before)
        moved = np.einsum("nij,nj->ni", T, positions - before.pose)
        stylization.start_from(T @ R @ T.swapaxes(1, 2), V + moved)
        return turns


def _partly_forgotten(state):
    """Return the rotations (n,3,3) and positions (n,3) of a state, a share nearer to rest."""
    R = (1.0 - FORGOTTEN) * state.rotations + FORGOTTEN * np.eye(3)
    is_opposite = np.trace(state.rotations, axis1=1, axis2=2) < -0.5  # no rotation lies between
    R[is_opposite] = state.rotations[is_opposite]
    R = orthonormalize(R, _ORTHONORMALIZATIONS)
    return R, state.pose + (1.0 - FORGOTTEN) * (state.positions - state.pose)
