# SPDX-License-Identifier: GPL-3.0-or-later
"""Flatten Facets: make the sides of cubic meshes exactly planar, for a crisp low-poly look."""

import math

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..cubic_craft_addon import hidden_source, mesh_bridge
from ..cubic_craft_addon.measure.facets import flat_facets
from ._shared.originals import OnOriginals
from ._shared.selection import poll_any_usable, poll_meshes, selected_meshes


class CUBIC_CRAFT_OT_flatten(OnOriginals, bpy.types.Operator):
    bl_idname = "cubic_craft.flatten"
    bl_label = "Flatten Facets"
    bl_description = (
        "Make the sides of the selected cubic meshes exactly planar, with straight edges between"
        " them. Restore still brings back the original"
    )
    done = "Flattened"

    angle: FloatProperty(
        name="Angle",
        description="Faces that are turned away from their side by more than this angle stay as"
        " they are",
        subtype="ANGLE",
        default=math.radians(20.0),
        min=0.0,
        max=math.radians(60.0),
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Largest distance that a vertex may be moved by, relative to the largest extent"
        " of the mesh",
        default=0.02,
        min=0.0,
        max=1.0,
        soft_max=0.1,
        precision=3,
        step=0.1,
    )
    dissolve: BoolProperty(
        name="N-Gons to New Object",
        description="Also make a new object of few planar faces, with flat shading. Edges stay"
        " around parts that seams, sharp edges, UVs or materials set apart",
        default=False,
    )
    edges: EnumProperty(
        name="Edges",
        description="What the edges between the sides of the new object get",
        items=(
            ("NONE", "As They Are", "No weights"),
            ("CREASES", "Creases", "Full creases, which a Subdivision Surface modifier keeps"),
            ("BEVEL", "Bevel Weights", "Full bevel weights, for a Bevel modifier limited by them"),
        ),
        default="NONE",
    )

    @classmethod
    def poll(cls, context):
        if not poll_meshes(cls, context):
            return False
        objects = [obj for obj in selected_meshes(context) if mesh_bridge.last_run(obj) is not None]
        return poll_any_usable(cls, objects, "The mesh has no result to flatten; cubify it first")

    def change(self, obj):
        """Flatten a mesh, or make a new object of it."""
        mesh = mesh_bridge.mesh_of(obj)
        mesh_bridge.end_preview(mesh)
        facets = flat_facets(obj, self.angle, self.tolerance, with_polygons=self.dissolve)
        was_edited = mesh_bridge.is_edited(mesh)
        facts = [
            f"{facets.count} planar facets, {facets.moved:,} vertices moved by"
            f" {facets.largest_move:.2g} or less"
        ]
        if was_edited:
            facts.append("edits made since Cubify are now part of the result")

        if self.dissolve:
            _write_ngons(obj, facets, self.edges)
            facts.append(f"{len(facets.polygons.loops):,} polygons in the new object")
        else:
            mesh_bridge.write_reshaped(obj, facets.positions)
        return "; ".join(facts)


def _write_ngons(obj, facets, edges):
    def finish(new):
        hidden_source.hide(obj, new)
        mesh_bridge.write_reshaped(obj, facets.positions)

    with hidden_source.source_kept(obj):
        mesh_bridge.write_ngons(obj, facets.polygons, edges, finish)
