# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases by name, and what is done with one: made, cubified by the operator, measured."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import art_character
import art_coarse
import art_figure
import art_meshes
import art_seams
import art_sheets
import art_solids
import bpy
import measures
import numpy as np
from art_objects import Surface, select, surface_of
from scipy.sparse import diags
from scipy.sparse.linalg import splu

import solver
from solver import method, rest_mesh

PAPER = {**method.PAPER, "keep_symmetric": True, "hold_rest": True}
"""the settings of the paper; what is symmetric stays so"""


@dataclass(frozen=True)
class Case:
    """How a mesh is made, and what is special about it."""

    make: Callable[[], list[bpy.types.Object]]
    options: dict = field(default_factory=dict)
    """of the operator"""


def _glb(make, cut):
    return lambda: cut(make())


def _shape(name):
    from figures import shapes  # of scripts/, which is not where everything that has cases can look

    return [getattr(shapes, name)()]


CASES = {
    "monkey": Case(art_meshes.monkey),
    "teapot": Case(art_meshes.teapot),
    "teapot_firm": Case(art_meshes.teapot, options={"solidity": 0.3}),
    "character": Case(art_character.character),
    "clothes": Case(art_figure.dressed),
    "body": Case(art_figure.body),
    "skin": Case(art_character.skin),
    # as if they had no limbs, since those become boxes along themselves
    "body_as_a_whole": Case(art_figure.body, options={"keep_pose": False}),
    "skin_as_a_whole": Case(art_character.skin, options={"keep_pose": False}),
    "bear": Case(partial(_shape, "bear")),
    "fox": Case(partial(_shape, "fox")),
    "painted": Case(art_figure.painted, options={"map_group": "Head"}),
    "painted_soft": Case(partial(art_figure.painted, border=0.1), options={"map_group": "Head"}),
    "monkey_seams": Case(_glb(art_meshes.monkey, art_seams.with_seams)),
    "monkey_flat": Case(_glb(partial(art_meshes.monkey, 1), art_seams.flat_shaded)),
    "teapot_seams": Case(_glb(art_meshes.teapot, art_seams.with_seams)),
    "character_seams": Case(_glb(art_character.character, art_seams.with_seams)),
    "monkey_2012": Case(partial(art_meshes.monkey, 1)),
    "monkey_507": Case(partial(art_meshes.monkey, 0)),
    "sphere": Case(art_coarse.sphere),
    "torus": Case(art_coarse.torus),
    "cylinder": Case(art_coarse.cylinder),
    "cone": Case(art_coarse.cone),
    "car": Case(art_coarse.car),
    "text": Case(art_coarse.text),
    "box_10": Case(partial(art_coarse.cuboid, (2, 1.5, 1), degrees=10)),
    "box_30": Case(partial(art_coarse.cuboid, (2, 1.5, 1), degrees=30)),
    "box_45": Case(partial(art_coarse.cuboid, (2, 1.5, 1), degrees=45)),
    "box_skew": Case(partial(art_coarse.cuboid, (2, 1.5, 1), (1, 2, 3), 35)),
    "crate": Case(partial(art_coarse.cuboid, (2, 1.5, 1), (1, 2, 3), 35, 0.1)),
    "plate": Case(partial(art_coarse.cuboid, (2, 1.5, 0.3), (0, 1, 0), 20, 0.1)),
    "house": Case(art_coarse.house),
    "house_30": Case(partial(art_coarse.house, 30)),
    "waves": Case(art_sheets.wavy_plane),
    "bowl": Case(art_sheets.bowl),
    "pipe": Case(art_sheets.pipe),
    "cape": Case(art_sheets.cape_at_wall),
    "cubes_at_sheet": Case(art_sheets.cubes_at_sheet),
    "two_sheets": Case(art_sheets.two_sheets),
    "hand": Case(art_solids.hand),
    "hand_inverted": Case(partial(art_solids.hand, is_inverted=True)),
    "spring": Case(art_solids.spring),
    "cup": Case(art_solids.cup),
    "pinched": Case(art_solids.pinched_torus),
    "mixed": Case(art_solids.mixed_winding),
    "fin": Case(art_solids.with_fin),
}


@dataclass(frozen=True)
class Outcome:
    """A case before and after, in world space."""

    rest: Surface
    after: Surface
    V: np.ndarray = field(init=False)
    """(n,3) positions at rest"""
    U: np.ndarray = field(init=False)
    """(n,3) positions after"""
    F: np.ndarray = field(init=False)
    """(m,3) triangles, those of rest"""

    def __post_init__(self):
        for name, value in (("V", self.rest.V), ("U", self.after.V), ("F", self.rest.F)):
            object.__setattr__(self, name, value)

    def angle(self):
        """Return the angle to the axes in degrees, at rest and after."""
        return measures.angle_to_axes(self.V, self.F), measures.angle_to_axes(self.U, self.F)

    def angle_ratio(self):
        """Return the angle to the axes after, divided by that at rest."""
        rest, after = self.angle()
        return after / rest

    def drift(self, is_welded=True):
        """Return the drift of parts; see `measures.drift`."""
        return measures.drift(self.V, self.U, self.F, is_welded)

    def seat(self, reach=measures.REACH):
        """Return the drift of vertices against the surface of other parts; see `measures.seat`."""
        return measures.seat(self.V, self.U, self.F, reach)

    def volume_ratio(self):
        """Return the volume after, divided by that at rest."""
        return measures.volume(self.U, self.F) / measures.volume(self.V, self.F)

    def new_crossings(self):
        """Return the number of triangles that cross others, and did not at rest."""
        return measures.new_crossings(self.V, self.U, self.F)

    def whole_angle(self):
        """Return the angle to the axes of the surface without its details, after."""
        return angle_of_the_whole(self.V, self.U, self.F)

    def inside(self):
        """Return the share of the clothes' vertices inside the body, at rest and after."""
        clothes = self.rest.owner > 0
        return tuple(
            measures.share_inside(surface.V[clothes], *surface.of(0))
            for surface in (self.rest, self.after)
        )


def angle_of_the_whole(V, U, F, size=0.06):
    """Return `angle_to_axes` of the surface smoothed over a share of the size: without details."""
    F = measures.welded(V, F)
    F = F[(F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])]
    rest = rest_mesh(V, F, solver.PAPER)
    normal = np.cross(U[F[:, 1]] - U[F[:, 0]], U[F[:, 2]] - U[F[:, 0]])
    sums = np.zeros((len(V), 3))
    for corner in F.T:
        np.add.at(sums, corner, normal)
    sums = sums[rest.used]
    sums /= np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None]
    area = diags(rest.areas + 1e-12)
    L = rest.skin.matrix(np.minimum(rest.skin.laplacian, 0.0))
    L = L - diags(L.diagonal())
    L = L - diags(np.asarray(L.sum(axis=1)).ravel())
    smooth = splu((area + size**2 / 4 * L).tocsc()).solve(area @ sums)
    smooth /= np.maximum(np.linalg.norm(smooth, axis=1), 1e-300)[:, None]
    cosine = np.minimum(np.abs(smooth).max(axis=1), 1.0)
    return float(np.degrees(np.average(np.arccos(cosine), weights=rest.areas)))


def cubified(objects, **options):
    """Run Cubify on objects and return the Outcome; what the operator does not know is left out."""
    rest = surface_of(objects)
    select(objects)
    done = bpy.ops.cubic_craft.cubify(**known(options))
    assert done == {"FINISHED"}
    return Outcome(rest, surface_of(objects))


@functools.cache
def outcome_of(name, cubeness=0.4, is_paper=False):
    """Cubify a case in an empty file, once however often it is asked for.

    `is_paper`: the energy of the paper, but with the rotation of the default settings.
    """
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    case = CASES[name]
    # Where the whole may turn, it may lie along the axes before anything can cross.
    settings = {**PAPER, "rotation": "KEEP"} if is_paper else {}
    return cubified(case.make(), cubeness=cubeness, **case.options, **settings)


def known(options):
    """Return those of the options that this version of the operator has, with that value."""
    properties = bpy.ops.cubic_craft.cubify.get_rna_type().properties
    return {
        name: value
        for name, value in options.items()
        if name in properties
        and (properties[name].type != "ENUM" or value in properties[name].enum_items)
    }
