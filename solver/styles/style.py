# SPDX-License-Identifier: GPL-3.0-or-later
"""What vertices are turned toward, and how strongly: as a caller says it."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..errors import CubicCraftError
from ..inputs import instances
from ..values import Value
from .forms import cube, named
from .polytope import Polytope

CRISPNESS = 0.9
"""of the extension; that of the paper is 0"""


@dataclass(frozen=True, eq=False, repr=False)
class Style(Value):
    """What vertices are turned toward, and how strongly.

    It may be the same for all N vertices of a mesh, or differ from vertex to vertex. That of a
    piece or a region is the same for all.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Setup, SolverOptions, Style, Stylization, ball, rest_mesh, run
    >>> V, F = ball()
    >>> setup = Setup(rest_mesh(V, F))
    >>> gem = Style(0.4, form="octahedron")
    >>> upper = np.where(V[:, 2] > 0, 1, 0)
    >>> half = Style(np.linspace(0.2, 0.6, 700), form=["cube", "octahedron"], form_of=upper)
    >>> for style in (gem, half):
    ...     result = run(Stylization(setup, style, options=SolverOptions(device="numpy")))
    ...     print(f"{np.linalg.norm(result.positions - V, axis=1).max():.2f}")
    0.22
    0.35
    """

    cubeness: ArrayLike
    """a number, or (N,) of them: weight lambda of the cubic term; 0 keeps the shape"""
    orientation: ArrayLike = field(default_factory=lambda: np.eye(3))
    """(3,3) or (N,3,3), rotation Q that maps a vector into the frame of the form; its rows are the
    form's axes. Beyond a plane of symmetry, forms other than the cube may also be mirrored"""
    form: str | Polytope | Sequence[str | Polytope] | None = None
    """what the normals are drawn to, by name or see `forms`, or several; None for the cube"""
    form_of: ArrayLike | None = field(default=None, kw_only=True)
    """(N,) int, which of several forms each vertex has"""
    crispness: ArrayLike = field(default=0.0, kw_only=True)
    """a number from 0 to 1, or (N,) of them: how far the sides of the cubic shape are made flat and
    its edges straight, see `hardening`"""
    detail_strength: ArrayLike = field(default=1.0, kw_only=True)
    """a number from 0, or (N,) of them: how high details stand out, relative to those at rest. What
    is a detail, `ProxyOptions.detail` says"""

    def __post_init__(self):
        form = self.form
        if isinstance(form, str):
            form = named(form)
        elif isinstance(form, Sequence):
            form = [(named(one) or cube()) if isinstance(one, str) else one for one in form]
        object.__setattr__(self, "form", form)  # frozen
        count = len(self.forms)
        if count > 1 and self.form_of is None:
            raise CubicCraftError(
                f"{count} values of form are given, but not which of them each vertex has; give"
                " form_of, or only one"
            )
        if self.form_of is not None and not count:
            raise CubicCraftError("form_of needs values of form to choose from; give them")

    @property
    def forms(self) -> list[Polytope]:
        """The forms as a list; empty for the cube. Raises CubicCraftError: they are not forms."""
        return [] if self.form is None else instances(self.form, "form", Polytope)

    @property
    def is_plain_cube(self) -> bool:
        """Whether a turn by a right angle, or a mirror image, is the same."""
        return self.form is None
