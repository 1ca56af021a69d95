# SPDX-License-Identifier: GPL-3.0-or-later
"""What vertices are turned toward, and how strongly: as a caller says it."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..inputs import instances
from ..normal_capture import NormalCapture
from ..values import Value
from .polytope import Polytope


@dataclass(frozen=True, eq=False, repr=False)
class Style(Value):
    """What vertices are turned toward, and how strongly.

    It may be the same for all N vertices of a mesh, or differ from vertex to vertex. That of a
    piece or a region is the same for all.

    See Also
    --------
    Stylization : Turns a mesh toward a style, and refuses one that does not fit it.
    piece_of : An object with a style, and others in regions.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.spatial import ConvexHull
    >>> from solver import Setup, SolverOptions, Style, Stylization, rest_mesh, run
    >>> from solver.styles.forms import cube, octahedron
    >>> z, a = np.linspace(-1, 1, 700), 2.4 * np.arange(700)  # a ball
    >>> V = np.stack([*(np.sqrt(1 - z**2) * [np.cos(a), np.sin(a)]), z], axis=1)
    >>> F = ConvexHull(V).simplices
    >>> F = np.where((np.linalg.det(V[F]) > 0)[:, None], F, F[:, ::-1])
    >>> setup = Setup(rest_mesh(V, F))
    >>> gem = Style(0.4, form=octahedron())
    >>> upper = np.where(z > 0, 1, 0)
    >>> half = Style(np.linspace(0.2, 0.6, 700), form=[cube(), octahedron()], form_of=upper)
    >>> for style in (gem, half):
    ...     result = run(Stylization(setup, style, options=SolverOptions(device="numpy")))
    ...     print(f"{np.linalg.norm(result.positions - V, axis=1).max():.2f}")
    0.14
    0.27
    """

    cubeness: ArrayLike
    """a number, or (N,) of them: weight lambda of the cubic term; 0 keeps the shape"""
    orientation: ArrayLike = field(default_factory=lambda: np.eye(3))
    """(3,3) or (N,3,3), rotation Q that maps a vector into the frame of the form; its rows are the
    form's axes. Beyond a plane of symmetry, forms other than the cube may also be mirrored"""
    form: Polytope | Sequence[Polytope] | None = None
    """what the normals are drawn to, see `forms`, or several of them; None for the cube"""
    form_of: ArrayLike | None = field(default=None, kw_only=True)
    """(N,) int, which of several forms each vertex has"""
    capture: NormalCapture | Sequence[NormalCapture] | None = field(default=None, kw_only=True)
    """how the normals should turn, in the frame of the form, or several such; None if they are
    free"""
    capture_strength: ArrayLike = field(default=0.0, kw_only=True)
    """a number, or (N,) of them: weight mu of the capture, in addition to the cubeness"""
    capture_of: ArrayLike | None = field(default=None, kw_only=True)
    """(N,) int, which of several captures each vertex has"""
    crispness: ArrayLike = field(default=0.0, kw_only=True)
    """a number from 0 to 1, or (N,) of them: how far the sides of the cubic shape are made flat and
    its edges straight, see `hardening`"""
    detail_strength: ArrayLike = field(default=1.0, kw_only=True)
    """a number from 0, or (N,) of them: how high details stand out, relative to those at rest. What
    is a detail, `ProxyOptions.detail` says"""

    @property
    def forms(self) -> list[Polytope]:
        """The forms as a list; empty for the cube.

        Raises
        ------
        CubicCraftError
            They are not Polytopes.
        """
        return [] if self.form is None else instances(self.form, "form", Polytope)

    @property
    def captures(self) -> list[NormalCapture]:
        """The captures as a list; empty for none.

        Raises
        ------
        CubicCraftError
            They are not NormalCaptures.
        """
        return [] if self.capture is None else instances(self.capture, "capture", NormalCapture)

    @property
    def is_plain_cube(self) -> bool:
        """Whether a turn by a right angle, or a mirror image, is the same."""
        return self.form is None and self.capture is None
