# SPDX-License-Identifier: GPL-3.0-or-later
"""From arrays to objects in the scene and back."""

import colorsys
from dataclasses import dataclass

import bpy
import numpy as np
from art_parts import united


@dataclass(frozen=True)
class Surface:
    """All objects of a case as one surface in world space."""

    V: np.ndarray
    """(n,3) float64"""
    F: np.ndarray
    """(m,3) int triangles"""
    owner: np.ndarray
    """(n,) int, the number of the object of each vertex"""

    def of(self, *numbers):
        """Return positions and triangles of some of the objects."""
        is_kept = np.isin(self.owner, numbers)
        renumbered = np.cumsum(is_kept) - 1
        return self.V[is_kept], renumbered[self.F[is_kept[self.F].all(axis=1)]]


def add(name, *parts, is_smooth=True):
    """Add an object of one mesh that has the parts, each with a material of its own."""
    (V, faces), part = united(parts)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(V.tolist(), [], faces)
    for number in range(len(parts) if len(parts) > 1 else 0):
        mesh.materials.append(material(number))
    if len(parts) > 1:
        mesh.polygons.foreach_set("material_index", np.array(part, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.full(len(faces), is_smooth))
    mesh.update()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def part_of(obj):
    """Return the mesh of an object as a part, in object space."""
    return positions(obj.data), [tuple(polygon.vertices) for polygon in obj.data.polygons]


def positions(mesh):
    """Return the positions of a mesh, (n,3) float64."""
    V = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", V.ravel())
    return V.astype(float)


def melted(name, parts, voxel, rounds=8):
    """Add an object whose closed skin is that of all parts together, evenly meshed and smooth."""
    obj = add(name, united(parts)[0])
    remesh = obj.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size, remesh.use_smooth_shade = "VOXEL", voxel, True
    smooth = obj.modifiers.new("Smooth", "SMOOTH")
    smooth.factor, smooth.iterations = 0.5, rounds
    apply_modifiers(obj)
    return obj


def apply_modifiers(obj):
    """Apply all modifiers of an object, in their order."""
    select([obj])
    for name in [modifier.name for modifier in obj.modifiers]:
        bpy.ops.object.modifier_apply(modifier=name)


def select(objects):
    """Select these objects only; the first is the active one."""
    bpy.context.view_layer.update()
    bpy.ops.object.select_all(action="DESELECT")
    for obj in objects:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]


def surface_of(objects):
    """Return the objects as they are now, without modifiers, as a Surface."""
    bpy.context.view_layer.update()
    points, triangles, owner, first = [], [], [], 0
    for number, obj in enumerate(objects):
        matrix = np.array(obj.matrix_world)
        V = positions(obj.data) @ matrix[:3, :3].T + matrix[:3, 3]
        obj.data.calc_loop_triangles()
        F = np.empty((len(obj.data.loop_triangles), 3), np.int32)
        obj.data.loop_triangles.foreach_get("vertices", F.ravel())
        points.append(V)
        triangles.append(first + F)
        owner.append(np.full(len(V), number))
        first += len(V)
    return Surface(np.concatenate(points), np.concatenate(triangles), np.concatenate(owner))


def paint(obj, name, weights):
    """Add a vertex group with a weight (n,) for each vertex."""
    group = obj.vertex_groups.new(name=name)
    for weight in np.unique(weights):
        group.add(np.flatnonzero(weights == weight).tolist(), float(weight), "REPLACE")


def material(number):
    """Return a material of a colour of its own, for the pictures."""
    name = f"Part {number}"
    material = bpy.data.materials.get(name) or bpy.data.materials.new(name)
    if not material.node_tree:
        material.use_nodes = True
    colour = (*colorsys.hsv_to_rgb((0.08 + 0.618 * number) % 1, 0.55, 0.5), 1.0)
    material.diffuse_color = colour
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = colour
    return material
