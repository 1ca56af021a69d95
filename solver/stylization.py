# SPDX-License-Identifier: GPL-3.0-or-later
"""The local-global iteration on one mesh, step by step."""

from collections.abc import Sequence
from copy import copy
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_matrix

from .acceleration import Momentum
from .aliases import Device, FloatArray, Precision
from .backends import local_step_class
from .energy import Energy
from .errors import CubicCraftError
from .global_step.holds import Holds
from .inputs import choices_per_vertex, instance, instances, real_numbers, switch
from .limbs import KnownLimbs, Limbs, no_limbs, turns
from .mesh.mesh_checks import per_vertex
from .normal_capture import NormalCapture, targets_for
from .setup import Setup
from .styles.admm import AdmmOptions
from .styles.polytope import Polytope
from .styles.polytopes import polytopes
from .symmetry import Mirror
from .values import Stored, described

_FIRST_SOLVES = 3  # where a solve is approximate, the first one starts far from the solution


class Stylization(Stored):
    """The state of one run: call `step` repeatedly and read `positions`.

    A pickled one continues from its shape when it is unpickled, without its momentum.

    Parameters
    ----------
    setup : Setup
    cubeness : float or (N,) numpy array
        Weight lambda of the cubic term, per vertex of the input; 0 keeps the shape.
    orientation : (3,3) or (N,3,3) numpy array, optional
        Rotation Q that maps a vector into the frame of the form; its rows are the form's axes.
    form : Polytope or sequence of Polytopes, optional
        What the normals are drawn to, see `forms`; by default the cube.
    form_of : (N,) numpy int array, optional
        Which of several forms each vertex of the input has.
    capture : NormalCapture or sequence of NormalCaptures, optional
        How the normals should turn, in the frame of the form; by default they are free.
    capture_strength : float or (N,) numpy array
        Weight mu of the capture, per vertex of the input, in addition to the cubeness.
    capture_of : (N,) numpy int array, optional
        Which of several captures each vertex of the input has.
    targets : (N,3) numpy array, optional
        Positions of the pinned vertices in the units of the input; by default their rest positions.
        The rows of all other vertices are ignored.
    device : {"auto", "cpu", "gpu", "numpy"}
        On a GPU, the arrays stay there. If the engine is reset during the run, every method that
        needs them raises a CubicCraftError.
    precision : "f64" or "f32", optional
        Of the local step in Taichi; by default the highest that the device supports.
    admm : AdmmOptions, optional
    is_accelerated : bool
        False for the plain iteration, in which the energy falls in every step.
    keep_rotation : bool
        Whether each component without pins keeps its orientation, and so does each of its large
        parts (`upright_parts`). Otherwise it may turn as a whole to fit the cube.
    is_coarse : bool
        Whether the mesh is a coarser one that provides the start for another.
    hold_matrices : sequence of (4,4) numpy arrays
        Maps of the groups of `Setup.with_holds`, in the units of the input.
    limbs : KnownLimbs, optional
        Limbs that are known for some vertices of the input, as from bones. Those of the others are
        found from the shape. Only with `ProxyOptions.keep_pose`.
    drawn : (n,3) numpy array, optional
        Normals of the solved vertices that the cubic term sees; by default those of `rest`.

    Attributes
    ----------
    setup, is_accelerated, is_coarse
        As given.
    rest : RestMesh
    iteration : int
        Number of steps done.
    energy : Energy or None
        At the point used by the last local step; after `finish`, that of the result.
    displacement, distance : float
        Largest displacement in the last step and largest distance from rest, in the unit box.

    Raises
    ------
    CubicCraftError
        An option is invalid, or the device is not available.

    See Also
    --------
    run, Run : Iterate it to the end.

    Notes
    -----
    The steps are those of Liu and Jacobson, "Cubic Stylization", ACM Transactions on Graphics
    38(6), 2019; `active_set` and `acceleration` describe the differences.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.spatial import ConvexHull
    >>> from solver import Setup, Stylization, rest_mesh
    >>> z, a = np.linspace(-1, 1, 700), 2.4 * np.arange(700)  # a ball
    >>> V = np.stack([*(np.sqrt(1 - z**2) * [np.cos(a), np.sin(a)]), z], axis=1)
    >>> F = ConvexHull(V).simplices
    >>> F = np.where((np.linalg.det(V[F]) > 0)[:, None], F, F[:, ::-1])
    >>> setup = Setup(rest_mesh(V, F))
    >>> stylization = Stylization(setup, 0.6, keep_rotation=True, device="numpy")
    >>> for _ in range(3):
    ...     stylization.step()
    ...     print(f"energy {stylization.energy.total:.2f}, moved {stylization.distance:.2f}")
    energy 2.75, moved 0.02
    energy 2.56, moved 0.06
    energy 2.48, moved 0.09
    """

    # what lies on the device: it is made anew from the positions and rotations
    _made_anew = ("_local", "_motion", "_constraints", "_acceleration")

    def __init__(
        self,
        setup: Setup,
        cubeness: ArrayLike,
        orientation: ArrayLike | None = None,
        targets: ArrayLike | None = None,
        form: Polytope | Sequence[Polytope] | None = None,
        form_of: ArrayLike | None = None,
        device: Device = "auto",
        precision: Precision | None = None,
        admm: AdmmOptions | None = None,
        is_accelerated: bool = True,
        keep_rotation: bool = False,
        is_coarse: bool = False,
        hold_matrices: Sequence[FloatArray] = (),
        capture: NormalCapture | Sequence[NormalCapture] | None = None,
        capture_strength: ArrayLike = 0.0,
        capture_of: ArrayLike | None = None,
        limbs: KnownLimbs | None = None,
        drawn: FloatArray | None = None,
    ):
        self.setup = instance(setup, "setup", Setup)
        self.is_accelerated = switch(is_accelerated, "is_accelerated")
        self.is_coarse = is_coarse
        self.is_started = False
        keep_rotation = self._keep_rotation = switch(keep_rotation, "keep_rotation")
        if admm is not None:
            instance(admm, "admm", AdmmOptions)
        if limbs is not None:
            instance(limbs, "limbs", KnownLimbs)
        self._options = {"device": device, "precision": precision, "admm": admm}
        rest = self.rest = setup.rest
        lam = self._lam = _spread(cubeness, "cubeness", setup)
        Q = _orientation(orientation, rest, may_mirror=not (form is None and capture is None))
        self._given_Q = Q
        self._form, self._form_of = form, _numbers(form, form_of, "form", Polytope, rest)
        self._capture = capture
        self._capture_of = _numbers(capture, capture_of, "capture", NormalCapture, rest)
        if drawn is None:
            drawn = rest.cubic_normals
            if form is not None or capture is not None:
                drawn = drawn * rest.outward
        self._drawn = drawn
        captured, mu = None, np.zeros_like(lam)
        if capture is not None:
            mu = _spread(capture_strength, "capture_strength", setup)
            captured = targets_for(capture, self._capture_of, mu, Q, drawn)
        self._mu = mu
        frames = rest.box_frames if keep_rotation and form is None else None
        self._Q = _with_boxes(self._along_limbs(Q, limbs), frames, mu == 0.0)
        self._captured = captured
        self._targets = _targets(targets, setup)
        self._hold_matrices = hold_matrices
        U = rest.V.copy()
        U[setup.pinned] += _moved(setup, self._targets) / rest.box.size
        self._begin(U)
        self.iteration = 0
        self.energy: Energy | None = None
        self.displacement = self.distance = 0.0

    def _begin(self, U):
        """Make both steps for the setup, from positions U (n,3)."""
        device, precision, admm = (self._options[x] for x in ("device", "precision", "admm"))
        self._local = local_step_class(device, precision)(
            self.rest,
            self._lam,
            self._Q,
            admm or AdmmOptions(),
            polytopes(self._form, self._form_of),
            self._captured,
            self._drawn,
        )
        constraints: list[Mirror | Holds] = list(self.setup.mirrors)
        if self.setup.hold_fields is not None:
            constraints.insert(0, Holds(self.setup.hold_fields, self._hold_matrices))
        self._constraints = constraints
        self._motion = self._local.motion(self.setup, U, constraints)
        self._acceleration = self._momentum()

    def __getstate__(self) -> dict[str, Any]:
        state = super().__getstate__()
        return {**state, "positions": self.positions, "rotations": self.rotations}

    def __setstate__(self, state: dict[str, Any]) -> None:
        U, R = state.pop("positions"), state.pop("rotations")
        self.__dict__.update(state)
        self._begin(U.copy())
        self._local.start_from(R)

    def __repr__(self) -> str:
        values = [("setup", self.setup), ("iteration", self.iteration), ("energy", self.energy)]
        return described(Stylization, [*values, ("device", self.device)])

    def continued(self, setup: Setup) -> "Stylization":
        """Return a Stylization that goes on from here, with another setup of the same vertices."""
        other = copy(self)
        other.setup, other.rest, other.is_started = setup, setup.rest, True
        other._begin(self.positions.copy())
        other._local.start_from(self.rotations.copy())
        still = np.zeros(other.rest.topology.component_count)
        for _ in range(_FIRST_SOLVES):
            other._motion.step(still, still, other._keep_rotation)
        return other

    def moved(
        self,
        setup: Setup,
        targets: ArrayLike | None = None,
        hold_matrices: Sequence[FloatArray] = (),
    ) -> "Stylization":
        """Return a Stylization that goes on from here with another rest shape.

        It begins with the present shape, in which each component is shifted as at rest, and each
        vertex moved as beside that, turned by its rotation. It needs few steps if the rest shape
        has hardly changed. Weights, limbs and how much normals count stay as they are, so the end
        is only near that of a new run.

        Parameters
        ----------
        setup : Setup
            Of `Setup.posed`.
        targets : (N,3) numpy array, optional
        hold_matrices : sequence of (4,4) numpy arrays
            As of a new one.
        """
        other = copy(self)
        other.setup, other.rest, other.is_started = setup, setup.rest, True
        rest = setup.rest
        turned = rest.normals - self.rest.normals
        if self._form is not None or self._capture is not None:
            turned = turned * rest.outward
        is_drawn = self._drawn.any(axis=1)
        other._drawn = _unit(np.where(is_drawn[:, None], self._drawn + turned, 0.0))
        if self._capture is not None:
            other._captured = targets_for(
                self._capture, self._capture_of, self._mu, self._given_Q, other._drawn
            )
        other._targets, other._hold_matrices = _targets(targets, setup), hold_matrices
        R = self.rotations.copy()
        moved = rest.V - self.rest.V
        shift = _means(moved, self.rest.areas, rest.topology.component)
        U = self.positions + shift + np.einsum("nij,nj->ni", R, moved - shift)
        held = setup.pinned
        U[held] = rest.V[held] + _moved(setup, other._targets) / rest.box.size
        other._begin(U)
        other._local.start_from(R)
        other.iteration, other.energy = 0, None
        return other

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
        return self._motion.positions

    @property
    def rotations(self) -> FloatArray:
        """(n,3,3) rotations of the last local step, of the vertices of `rest`."""
        return self._local.R

    @property
    def orientations(self) -> FloatArray:
        """(N,3,3) rotations into the frame of the form, of the vertices of the input."""
        rest = self.rest
        found = np.tile(self._Q[0], (len(rest.input_positions), 1, 1))
        used, place = rest.place
        found[used] = np.broadcast_to(self._Q, (len(rest.V), 3, 3))[place]
        return found

    def coarser(self) -> "Stylization":
        """Return a new Stylization of the coarser mesh of the setup, which must have one."""
        setup, coarsening = self.setup.coarse, self.rest.coarse
        assert setup is not None and coarsening is not None
        areas = self.rest.areas + 1e-300
        count = len(coarsening.rest.V)
        _, first = np.unique(coarsening.cluster, return_index=True)
        Q = self._Q[first] if len(self._Q) > 1 else self._Q[0]

        def means(values, weights):
            sums = np.bincount(coarsening.cluster, weights * values, count)
            total = np.bincount(coarsening.cluster, weights, count)
            return sums / np.where(total > 0.0, total, 1.0)

        drawn = None  # the normals of the coarser mesh, where details count
        if self.rest.options.detail:
            drawn = _unit(np.stack([means(x, areas) for x in self._drawn.T], axis=1))
        is_pinned = np.zeros(len(self.rest.V))
        is_pinned[self.setup.pinned] = 1.0
        free = areas * (1.0 - is_pinned) + 1e-300
        moved = (self.positions - self.rest.V).T
        return Stylization(
            setup,
            means(self._lam, free),
            Q,
            coarsening.rest.input_positions
            + np.stack([means(column, is_pinned) for column in moved], axis=1),
            form=self._form,
            form_of=self._form_of[first],
            **self._options,
            keep_rotation=True,
            is_coarse=True,
            hold_matrices=self._hold_matrices_of(setup),
            capture=self._capture,
            capture_strength=means(self._mu, free),
            capture_of=self._capture_of[first],
            drawn=drawn,
        )

    def _along_limbs(self, Q, limbs):
        """Return the orientations (n,3,3) that limbs turn with them, or Q as it is."""
        rest = self.rest
        if not rest.options.keep_pose:
            return Q
        if limbs is None:
            found = rest.limbs
        else:
            is_known, found = _at_solved(limbs, rest)
            if not is_known.all():
                found = rest.limbs.replaced(is_known, found)
        if not len(found):
            return Q
        forms = () if self._form is None else self._form
        forms = [forms] if isinstance(forms, Polytope) else forms
        G = turns(found, Q, forms, self._form_of)
        for mirror in self.setup.mirrors:
            mirror.impose_rotations(G)
        return Q @ G

    def _hold_matrices_of(self, coarse):
        """Return the matrices in the units of a coarser mesh, which are those of the unit box."""
        if coarse.hold_fields is None:
            return ()
        box = self.rest.box
        into = np.diag([box.size, box.size, box.size, 1.0])
        into[:3, 3] = box.origin
        return [np.linalg.inv(into) @ np.asarray(matrix) @ into for matrix in self._hold_matrices]

    def _momentum(self):
        return Momentum(self.rest.topology.component_count) if self.is_accelerated else None

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
            momentum, overshoot, self._keep_rotation
        )
        self.iteration += 1

    def finish(self) -> Energy:
        """Fit the rotations to the last positions and return the Energy of both."""
        self._motion.look_at_positions()
        self.local_step()
        assert self.energy is not None  # the local step has set it
        return self.energy

    def energy_of(self, positions: ArrayLike, steps: int = 20) -> Energy:
        """Return the Energy of a given shape, with rotations that fit it.

        Parameters
        ----------
        positions : (N,3) numpy array
            In the units of the input. They replace the state of the run.
        steps : int
            Number of local steps; each starts from the rotations of the previous one, and the best
            counts.

        Returns
        -------
        Energy
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


def _orientation(Q, rest, may_mirror):
    """Return the orientation as (1,3,3) or (n,3,3) rotations of the used vertices.

    Beyond a plane of symmetry, a form that is not its own mirror image is reflected.
    """
    if Q is None:
        return np.eye(3)[None]
    Q = real_numbers(Q, "the orientation")
    if Q.shape == (3, 3):
        Q = Q[None]
    elif Q.shape == (len(rest.input_positions), 3, 3):
        Q = Q[rest.used]
    else:
        raise CubicCraftError(f"the orientation must have the shape (3, 3), not {Q.shape}")
    is_orthogonal = np.abs(Q @ Q.swapaxes(1, 2) - np.eye(3)).max() < 1e-6
    if not (is_orthogonal and (may_mirror or (np.linalg.det(Q) > 0.0).all())):
        raise CubicCraftError("the orientation must be a rotation matrix")
    return Q


def _spread(weights, name, setup):
    """Return a number or weights (N,) of the input at the solved vertices (n,)."""
    rest = setup.rest
    weights = per_vertex(weights, name, len(rest.input_positions))
    weights = rest.input_map.spread(weights) * rest.cubic_shares
    weights[setup.pinned] = 0.0  # otherwise their rotations would shear the pinned part
    return weights


def _numbers(values, of_input, name, kind, rest):
    """Return the number of the form or the capture (n,) of the used vertices."""
    several = [] if values is None else instances(values, name, kind)
    if of_input is None or not several:
        return np.zeros(len(rest.V), int)
    count = len(rest.input_positions)
    return choices_per_vertex(of_input, f"{name}_of", count, len(several))[rest.used]


def _targets(targets, setup):
    """Return the targets as (N,3) positions in the units of the input; only pins matter."""
    at_rest = setup.rest.input_positions
    if targets is None:
        return at_rest
    targets = real_numbers(targets, "targets")
    if targets.shape != at_rest.shape:
        raise CubicCraftError(f"targets must have the shape {at_rest.shape}, not {targets.shape}")
    if not np.isfinite(targets[setup.pinned_input]).all():
        raise CubicCraftError("the targets of pinned vertices must be finite")
    return targets


def _moved(setup, targets):
    """Return the displacements (k,3) from rest to the targets of the pinned solved vertices."""
    rest = setup.rest
    moved = np.zeros_like(rest.input_positions)
    share = np.zeros(len(moved))
    share[setup.pinned_input] = 1.0
    moved[setup.pinned_input] = (targets - rest.input_positions)[setup.pinned_input]
    # of welded vertices, only the pinned ones count
    moved, share = (rest.input_map.spread(x)[setup.pinned] for x in (moved, share))
    return moved / share[:, None]


def _at_solved(limbs, rest):
    """Return where Limbs of the input are known at the solved vertices (n,), and what they are."""
    known = np.asarray(limbs.known, dtype=np.float64)
    share_known = rest.input_map.spread(known)
    if not len(limbs):
        return share_known > 0.0, no_limbs(len(rest.V))
    shares = rest.input_map.spread(limbs.shares.multiply(known[:, None]).toarray())
    shares /= np.where(share_known > 0.0, share_known, 1.0)[:, None]
    return share_known > 0.0, Limbs(limbs.directions, csr_matrix(shares), carried=limbs.carried)


def _means(vectors, weights, component):
    """Return the weighted mean of the vectors (n,3) of each component at its vertices (n,3)."""
    weights = weights + 1e-300
    total = np.bincount(component, weights)
    sums = [np.bincount(component, weights * column) / total for column in vectors.T]
    return np.stack(sums, axis=1)[component]


def _unit(vectors):
    """Return vectors (n,3) with the length 1, or zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(length > 1e-12, vectors, 0.0) / np.where(length > 1e-12, length, 1.0)


def _with_boxes(Q, frames, is_free):
    """Return those of rotated boxes instead, see `proxy/boxes`, where nothing is captured (n,)."""
    if frames is None:
        return Q
    turn = np.abs(Q @ frames.swapaxes(1, 2))
    is_askew = frames.any(axis=(1, 2)) & (np.minimum(turn, 1.0 - turn).max(axis=(1, 2)) > 1e-9)
    is_askew &= is_free
    if not is_askew.any():
        return Q
    return np.where(is_askew[:, None, None], frames, Q)
