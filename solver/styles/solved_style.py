# SPDX-License-Identifier: GPL-3.0-or-later
"""A style at the vertices that are solved, as the local step takes it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_matrix

from ..aliases import BoolArray, FloatArray, IntArray
from ..errors import CubicCraftError
from ..inputs import choices_per_vertex, real_numbers
from ..iteration.setup import Setup
from ..limbs import KnownLimbs, Limbs, no_limbs, turns
from ..mesh.mesh_checks import per_vertex
from ..surface.details import unit
from ..surface.rest import RestMesh
from ..values import Value
from .polytope import Polytope
from .style import Style


@dataclass(frozen=True, eq=False, repr=False)
class SolvedStyle(Value):
    """A Style at the n vertices that are solved."""

    cubeness: FloatArray
    """(n,) as given; 0 at pins, whose rotations would otherwise shear the pinned part"""
    lam: FloatArray
    """(n,) what counts of it, see `RestMesh.cubic_shares`"""
    orientation: FloatArray
    """(1,3,3) or (n,3,3) as given"""
    Q: FloatArray
    """(1,3,3) or (n,3,3) the same, turned so that limbs and boxes lie along their forms"""
    forms: list[Polytope]
    """empty for the cube"""
    form_of: IntArray
    """(n,) int"""
    normals: FloatArray
    """(n,3) unit normals at rest that the cubic term sees, or zero"""
    crispness: FloatArray
    """(n,) from 0 to 1; 0 where nothing draws the normals to the form"""
    detail_strength: FloatArray
    """(n,) relative to the details at rest; 1 at pins"""
    is_drawn: BoolArray
    """(n,) bool, where normals are drawn to the form"""

    def with_crispness(self, crispness: ArrayLike, setup: Setup) -> "SolvedStyle | None":
        """Return the style with another crispness, None if that is 0 at other vertices."""
        values = np.minimum(_at_free(crispness, "crispness", setup, at_pins=0.0), 1.0)
        values = np.where(self.is_drawn, values, 0.0)
        if ((values > 0.0) != (self.crispness > 0.0)).any():
            return None
        return replace(self, crispness=values)

    def limited(self, most: float) -> FloatArray:
        """Return `lam` (n,) for a cubeness of at most so much."""
        is_more = self.cubeness > most
        return np.where(is_more, most / np.where(is_more, self.cubeness, 1.0), 1.0) * self.lam

    def posed(self, before: RestMesh, after: RestMesh) -> "SolvedStyle":
        """Return the style in another pose: only the normals have turned, as the surface has."""
        turned = after.normals - before.normals
        if self.forms:
            turned = turned * after.outward
        is_drawn = np.any(self.normals, axis=1)
        normals = unit(np.where(is_drawn[:, None], self.normals + turned, 0.0))
        return replace(self, normals=normals)


def solved_style(
    style: Style,
    setup: Setup,
    limbs: KnownLimbs | None = None,
    *,
    keep_rotation: bool = False,
    normals: FloatArray | None = None,
) -> SolvedStyle:
    """Return a Style of the N vertices of the input at the n that are solved.

    `limbs`: KnownLimbs, optional, as of `Pose`. `keep_rotation`: as of `SolverOptions`: boxes then
    stay as they lie. `normals`: (n,3), optional, what the cubic term sees; by default the normals
    without their details. Raises CubicCraftError: the style does not fit the mesh, or a value of it
    is invalid.
    """
    rest = setup.rest
    cubeness = _at_free(style.cubeness, "cubeness", setup, at_pins=0.0)
    lam = cubeness * rest.cubic_shares
    orientation = _orientation(style, rest)
    forms = style.forms
    form_of = _numbers(style.form_of, "form_of", len(forms), rest)
    if normals is None:
        normals = rest.cubic_normals
        if not style.is_plain_cube:
            normals = normals * rest.outward
    own = orientation
    if keep_rotation and not forms:
        own = _along_boxes(orientation, rest.box_frames[0])
    Q = _along_limbs(own, limbs, forms, form_of, setup)
    if own is not orientation:
        Q = np.where(rest.box_frames[1][:, None, None], own, Q)
    crispness = _at_free(style.crispness, "crispness", setup, at_pins=0.0)
    is_drawn = cubeness > 0.0
    return SolvedStyle(
        *(cubeness, lam, orientation, Q, forms, form_of, normals),
        np.where(is_drawn, np.minimum(crispness, 1.0), 0.0),
        _at_free(style.detail_strength, "detail_strength", setup, at_pins=1.0),
        is_drawn,
    )


def _at_free(values, name, setup, *, at_pins):
    """Return a number or values (N,) of the input at the solved vertices (n,), but for pins."""
    rest = setup.rest
    values = rest.input_map.spread(per_vertex(values, name, len(rest.input_positions)))
    values = np.array(values)
    values[setup.pinned] = at_pins
    return values


def _orientation(style, rest):
    """Return the orientation as (1,3,3) or (n,3,3) rotations of the used vertices.

    Beyond a plane of symmetry, a form that is not its own mirror image is reflected.
    """
    Q = real_numbers(style.orientation, "the orientation")
    if Q.shape == (3, 3):
        Q = Q[None]
    elif Q.shape == (len(rest.input_positions), 3, 3):
        Q = Q[rest.used]
    else:
        raise CubicCraftError(f"the orientation must have the shape (3, 3), not {Q.shape}")
    is_orthogonal = np.abs(Q @ Q.swapaxes(1, 2) - np.eye(3)).max() < 1e-6
    if not (is_orthogonal and (not style.is_plain_cube or (np.linalg.det(Q) > 0.0).all())):
        raise CubicCraftError("the orientation must be a rotation matrix")
    return Q


def _numbers(of_input, name, count, rest):
    if of_input is None or not count:
        return np.zeros(len(rest.V), int)
    return choices_per_vertex(of_input, name, len(rest.input_positions), count)[rest.used]


def _along_limbs(Q, limbs, forms, form_of, setup):
    """Return the orientations (n,3,3) that limbs turn with them, or Q as it is."""
    rest = setup.rest
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
    G = turns(found, Q, forms, form_of)
    for mirror in setup.mirrors:
        mirror.impose_rotations(G)
    return Q @ G


def _at_solved(limbs, rest):
    """Return where Limbs of the input are known at the solved vertices (n,), and what they are."""
    known = np.asarray(limbs.known, dtype=np.float64)
    share_known = rest.input_map.spread(known)
    if not len(limbs):
        return share_known > 0.0, no_limbs(len(rest.V))
    shares = rest.input_map.spread(limbs.shares.multiply(known[:, None]).toarray())
    shares /= np.where(share_known > 0.0, share_known, 1.0)[:, None]
    return share_known > 0.0, Limbs(limbs.directions, csr_matrix(shares), carried=limbs.carried)


def _along_boxes(Q, frames):
    """Return those of rotated boxes instead, see `proxy/boxes`."""
    if frames is None:
        return Q
    turn = np.abs(Q @ frames.swapaxes(1, 2))
    is_askew = frames.any(axis=(1, 2)) & (np.minimum(turn, 1.0 - turn).max(axis=(1, 2)) > 1e-9)
    if not is_askew.any():
        return Q
    return np.where(is_askew[:, None, None], frames, Q)
