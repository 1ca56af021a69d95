# SPDX-License-Identifier: GPL-3.0-or-later
"""How steadily the frames of an animation follow each other, and how to make them steadier.

A vertex jumps in frame f by the size of its second difference in time, |x_f+1 - 2 x_f + x_f-1|. A
stylized surface may jump where the input moves smoothly, when a minimum of the energy vanishes. So
where it jumps farther than the input does, and than is small beside its speed and its size, it is
smoothed over time: not the positions, which would blunt the motion, but the offset of each vertex
from its place in the input, as seen by the surface around it. The motion of the input is kept as it
is, and so is a limb that turns fast with its offsets.

Arrays are indexed by frame and vertex, (f,k,...). An animation is passed in pieces of all its
frames and some of its vertices, so that it need not fit into the memory.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from ..aliases import FloatArray, RealArray
from ..values import described, is_same

MOST_JUMPS = 3.0
"""Jumps of the result over those of the input, in the largest and in the 99th percentile"""
WIDTHS = (0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0)
"""standard deviations of the Gaussian in frames; the first that keeps `MOST_JUMPS` is used"""
_STEADY = 0.05  # of the speed: the jumps of what takes 20 frames to reach it
_UNSEEN = 1e-5  # of the size: less than a pixel in any picture
_BINS = np.geomspace(1e-12, 1e6, 4001)  # a relative 1 %


class Frames(NamedTuple):
    """Some vertices of an animation, in all frames; `frame_of` makes those of one frame.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Frames
    >>> turns = np.tile([0.0, 0, 0, 1], (5, 1, 1))
    >>> Frames(np.zeros((5, 1, 3)), turns, np.eye(5, 3)[:, None]).results(1.0).shape
    (5, 1, 3)
    """

    inputs: RealArray
    """(f,k,3) positions of the input"""
    turns: RealArray
    """(f,k,4) rotations of the surroundings since the first frame, as quaternions x, y, z, w"""
    offsets: RealArray
    """(f,k,3) from there to the result, in the frame of the surroundings"""

    def __eq__(self, other: object) -> bool:
        return type(other) is Frames and all(map(is_same, self, other))

    def __ne__(self, other: object) -> bool:
        return not self == other  # a tuple's own would compare arrays

    def __repr__(self) -> str:
        return described(Frames, self._asdict().items())

    def results(self, width: float) -> FloatArray:
        """Return the positions (f,k,3), smoothed by a Gaussian of a width in frames."""
        offsets = np.asarray(self.offsets, dtype=np.float64)
        if width > 0.0:
            offsets = gaussian_filter1d(offsets, width, axis=0, mode="nearest")
        shape = offsets.shape
        turns = Rotation.from_quat(np.asarray(self.turns, dtype=np.float64).reshape(-1, 4))
        return self.inputs + turns.apply(offsets.reshape(-1, 3)).reshape(shape)


def frame_of(inputs: FloatArray, turns: FloatArray, positions: FloatArray) -> Frames:
    """Return the `Frames` of a single frame, of an input and its result (k,3).

    `turns`: (k,3,3), see `FrameSequence.turns`.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import frame_of
    >>> frame = frame_of(np.zeros((1, 3)), np.eye(3)[None], np.ones((1, 3)))
    >>> frame.results(0.0)
    array([[[1., 1., 1.]]])
    """
    rotations = Rotation.from_matrix(turns)
    offsets = rotations.apply(positions - inputs, inverse=True)
    return Frames(inputs[None], rotations.as_quat()[None], offsets[None])


class _Lengths:
    """The lengths of vectors, collected piece by piece."""

    def __init__(self):
        self.largest = 0.0
        self._counts = np.zeros(len(_BINS) + 1, dtype=np.int64)

    def add_vectors(self, vectors):
        """Add the lengths of vectors (f,k,3)."""
        sizes = np.sqrt((vectors * vectors).sum(axis=2)).ravel()
        if len(sizes):
            self.largest = max(self.largest, float(sizes.max()))
            self._counts += np.bincount(np.searchsorted(_BINS, sizes), minlength=len(_BINS) + 1)

    def percentile(self, q):
        """Return what q % of the lengths do not exceed, within 1 %."""
        total = self._counts.sum()
        if not total:
            return 0.0
        at = np.searchsorted(np.cumsum(self._counts), q / 100.0 * total)
        return min(float(_BINS[min(at, len(_BINS) - 1)]), self.largest)

    @property
    def measures(self) -> tuple[float, float]:
        """The largest, and the 99th percentile."""
        return self.largest, self.percentile(99)


class Jumps(_Lengths):
    """The sizes of all jumps, collected piece by piece."""

    def add(self, positions):
        """Add vertices (f,k,3) in all frames."""
        second = np.asarray(positions[2:], dtype=np.float64) - positions[1:-1]
        second += np.asarray(positions[:-2], dtype=np.float64) - positions[1:-1]
        self.add_vectors(second)

    def over(self, motion):
        """Return the ratios to those of a `Motion`: of the largest, and of the 99th percentile."""
        pairs = zip(self.measures, motion.measures, strict=True)
        return tuple(mine / theirs if theirs > 0.0 else 0.0 for mine, theirs in pairs)


class Motion(Jumps):
    """The jumps of an input, where they are more than what nobody sees.

    What moves along straight lines at an even speed has none, and what hardly moves has hardly any.
    Beside its speed and its size, those of the result may still be small.
    """

    def __init__(self):
        super().__init__()
        self._steps = _Lengths()
        self._low, self._high = np.inf, -np.inf

    def add(self, positions):
        """Add vertices (f,k,3) in all frames."""
        super().add(positions)
        self._steps.add_vectors(np.diff(np.asarray(positions, dtype=np.float64), axis=0))
        self._low = np.minimum(self._low, positions.min(axis=1))
        self._high = np.maximum(self._high, positions.max(axis=1))

    @property
    def measures(self):
        """The largest, and the 99th percentile; 0 where nothing moves."""
        if not self._steps.largest > 0.0:
            return 0.0, 0.0
        unseen = _UNSEEN * float(np.max(self._high - self._low))
        jumps, steps = super().measures, self._steps.measures
        largest, percentile = (
            max(jump, _STEADY * step, unseen) for jump, step in zip(jumps, steps, strict=True)
        )
        return largest, percentile


def least_width(pieces: Callable[[], Iterable[Frames]]) -> tuple[float, tuple[float, ...]]:
    """Return the least of `WIDTHS` that keeps `MOST_JUMPS`, or the largest, and the ratios then.

    `pieces`: callable, returns an iterator over `Frames` with all vertices, each time it is called.

    The ratios are those of the largest jumps and of the 99th percentile to those of the input,
    which count as at least a small share of its speed and size; 0 where the input lies still.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Frames, least_width
    >>> inputs = np.random.default_rng(1).normal(size=(9, 1, 3))
    >>> frames = Frames(inputs, np.tile([0.0, 0, 0, 1], (9, 1, 1)), np.zeros((9, 1, 3)))
    >>> least_width(lambda: [frames])
    (0.0, (1.0, 1.0))
    """
    inputs = Motion()
    for piece in pieces():
        inputs.add(piece.inputs)
    ratios = 0.0, 0.0
    for width in WIDTHS:
        jumps = Jumps()
        for piece in pieces():
            jumps.add(piece.results(width))
        ratios = jumps.over(inputs)
        if max(ratios) <= MOST_JUMPS:
            return width, ratios
    return WIDTHS[-1], ratios
