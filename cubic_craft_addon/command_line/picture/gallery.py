# SPDX-License-Identifier: GPL-3.0-or-later
"""Place the original and its cubic versions side by side in a scene of their own.

The meshes are not touched: whatever their size and place, each group (all objects of the input at
one cubeness) hangs on an empty that scales it to the same size and stands it on the floor.
`scripts/figures` arranges groups of its own with the same means.
"""

import math
from argparse import Namespace
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from ....solver.console.output import InputError
from ... import mesh_bridge
from ..solving.cubify_all import Sculpture
from ..writing.detached import detached_copy

SIZE = 2.0
"""largest extent of the original in the gallery; everything else is measured by it"""
GAP = 0.3
"""between two neighbors"""
LABEL_SIZE = 0.19
LABEL_LIFT = 0.03
"""of a label above the floor, which would cut it"""
LABEL_GAP = 0.12
"""in the picture, between a label and what it names"""
YAW = math.radians(32.0)
"""turn toward the camera that shows three faces of a cube"""
ELEVATION = math.radians(18.0)
"""of the camera"""
UP = Vector((0.0, math.sin(ELEVATION), math.cos(ELEVATION)))
"""the picture's vertical, for a camera that looks along Y"""


@dataclass
class Gallery:
    """What stands in the scene."""

    scene: bpy.types.Scene
    turntables: list[bpy.types.Object]
    """one empty per group; turn them about Z"""
    center: Vector
    """what the camera looks at"""
    width: float
    height: float
    """of all that the picture must show, along its sides"""
    finishes: list[str]
    """of each group, a name of `studio.FINISHES`; meshes with materials of their own keep those"""


@dataclass
class Group:
    """What stands on one turntable: the input at one cubeness, say."""

    label: str
    copies: list[bpy.types.Object]
    places: list[Matrix]
    """where each copy is, stood upright"""
    points: np.ndarray
    """(n,3) of what can be seen, in the space of the places"""
    extent: float
    """what becomes `SIZE`: the largest extent of the original"""
    finish: str
    yaw: float = YAW
    """turn about the vertical"""


def build_gallery(sculptures: list[Sculpture], options: Namespace) -> Gallery:
    """Build the gallery for the picture's format, with room to turn for a turntable."""
    scene = scene_for_gallery()
    groups = _groups(sculptures, options, scene)
    return arrange(groups, scene, options.resolution, turns=options.turntable > 0)


def scene_for_gallery() -> bpy.types.Scene:
    """Make an empty scene and show it."""
    scene = bpy.data.scenes.new("Gallery")
    bpy.context.window.scene = scene
    return scene


def arrange(
    groups: list[Group], scene: bpy.types.Scene, resolution: tuple[int, int], turns: bool = False
) -> Gallery:
    """Stand the groups side by side, with their labels, as large as the resolution allows.

    `groups`: their copies are in the scene, which is shown. `turns`: leave room for a turn of each.
    """
    outlines = np.array([outline(group, turns) for group in groups])
    labels = [_label(group.label, scene) for group in groups]
    bpy.context.view_layer.update()
    width = max((outlines[:, 1] - outlines[:, 0]).max(), *(label.dimensions.x for label in labels))
    bottom = outlines[:, 2].min() - LABEL_GAP - LABEL_SIZE
    top = outlines[:, 3].max()
    pitch_x, pitch_z = float(width) + GAP, float(top - bottom) + GAP
    columns, rows = _grid(len(groups), pitch_x, pitch_z, *resolution)
    center = UP * ((bottom + top) / 2)
    finishes = [group.finish for group in groups]
    gallery = Gallery(scene, [], center, columns * pitch_x, rows * pitch_z, finishes)
    for number, (group, extents, label) in enumerate(zip(groups, outlines, labels, strict=True)):
        row, column = divmod(number, columns)
        in_row = min(columns, len(groups) - row * columns)
        x = (column - (in_row - 1) / 2) * pitch_x
        # Rows are apart in the picture; on the floor that takes much more.
        y = ((rows - 1) / 2 - row) * pitch_z / math.sin(ELEVATION)
        axis = Vector((x - (extents[0] + extents[1]) / 2, y, 0.0))
        gallery.turntables.append(stand(group, axis, scene))
        label.location = (x, y + bottom / math.sin(ELEVATION), LABEL_LIFT)
    return gallery


def _groups(sculptures: list[Sculpture], options: Namespace, scene: bpy.types.Scene) -> list[Group]:
    versions = [("original", None)]
    versions += [(f"cubeness {value!r}", number) for number, value in enumerate(options.cubeness)]
    turn = Euler([math.radians(angle) for angle in options.turn]).to_matrix().to_4x4()
    groups, yaw = [], math.radians(options.view)
    for label, number in versions:
        copies, places = [], []
        for sculpture in sculptures:
            original = sculpture.member.shape.original
            shape = original if number is None else sculpture.shape(number)
            for user in sculpture.users:
                copy = detached_copy(user, shape, keep_modifiers=True)
                if number is not None:
                    mesh_bridge.shade_shape(copy, vars(options))
                scene.collection.objects.link(copy)
                copies.append(copy)
                places.append(turn @ user.matrix_world)
        bpy.context.view_layer.update()
        if groups:
            _check_seen(sculptures, groups[0].copies, copies)
        points = np.concatenate([_points(*pair) for pair in zip(copies, places, strict=True)])
        extent = groups[0].extent if groups else extent_of(points)
        finish = "clay" if number is None else "teal"
        groups.append(Group(label, copies, places, points, extent, finish, yaw))
    return groups


def _check_seen(
    sculptures: list[Sculpture], originals: list[bpy.types.Object], copies: list[bpy.types.Object]
) -> None:
    """Raise InputError if the picture of a copy would be that of the original."""
    users = [user for sculpture in sculptures for user in sculpture.users]
    for user, original, copy in zip(users, originals, copies, strict=True):
        if not copy.modifiers:
            continue
        moved = mesh_bridge.distance(
            mesh_bridge.read_position(original.data), mesh_bridge.read_position(copy.data)
        )
        before, now = (mesh_bridge.read_evaluated_points(obj)[0] for obj in (original, copy))
        if moved > 0.0 and mesh_bridge.is_still(before, now, moved):
            raise InputError(
                f'"{user.name}": one of its modifiers shows the original still;'
                " --with-modifiers makes that cubic"
            )


def extent_of(points: np.ndarray) -> float:
    """Return the largest extent of points (n,3); 1 if there is none."""
    return float(np.ptp(points, axis=0).max()) or 1.0


def _points(copy: bpy.types.Object, place: Matrix) -> np.ndarray:
    """(n,3) vertices of faces as they are rendered, where ``place`` takes them."""
    evaluated = copy.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = mesh_bridge.read_values(mesh.vertices, "co", width=3)
    corners = mesh_bridge.read_values(mesh.loops, "vertex_index", np.int32)
    evaluated.to_mesh_clear()
    matrix = np.array(place)
    visible = points[np.unique(corners)].astype(np.float64)
    return visible @ matrix[:3, :3].T + matrix[:3, 3]


def outline(group: Group, turns: bool) -> tuple[float, float, float, float]:
    """Return left, right, bottom and top of a group in the picture.

    Measured from where its axis meets the floor, along the directions of the picture.
    """
    points = (group.points - _foot(group)) * (SIZE / group.extent)
    if turns:
        radius = np.linalg.norm(points[:, :2], axis=1).max()
        rim = radius * math.sin(ELEVATION)
        return -radius, radius, -rim, points[:, 2].max() * UP.z + rim
    points = points @ np.array(Matrix.Rotation(group.yaw, 3, "Z")).T
    across, up = points[:, 0], points @ np.array(UP)
    return across.min(), across.max(), up.min(), up.max()


def _foot(group: Group) -> np.ndarray:
    """Where the group's vertical axis meets the floor, in the space of the places."""
    low, high = group.points.min(axis=0), group.points.max(axis=0)
    return np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])


def _grid(
    count: int, width: float, height: float, picture_width: int, picture_height: int
) -> tuple[int, int]:
    """Columns and rows that show so many frames of a size as large as possible in a picture."""

    def needed(rows: int) -> float:
        return max(math.ceil(count / rows) * width / picture_width, rows * height / picture_height)

    rows = min(range(1, count + 1), key=needed)
    columns = math.ceil(count / rows)
    return columns, math.ceil(count / columns)


def stand(group: Group, place: Vector, scene: bpy.types.Scene) -> bpy.types.Object:
    """Hang the group on an empty that turns and scales it, and stand it on the floor."""
    turntable = bpy.data.objects.new(group.label, None)
    scene.collection.objects.link(turntable)
    turntable.location = place
    turntable.rotation_euler.z = group.yaw
    turntable.scale = [SIZE / group.extent] * 3
    to_foot = Matrix.Translation(Vector(-_foot(group)))
    for copy, world in zip(group.copies, group.places, strict=True):
        # The inverse can hold any matrix, also a sheared one; location, rotation and scale cannot.
        own = copy.matrix_world.copy()
        copy.parent = turntable
        copy.matrix_parent_inverse = to_foot @ world @ own.inverted_safe()
    return turntable


def _label(text: str, scene: bpy.types.Scene) -> bpy.types.Object:
    curve = bpy.data.curves.new("Label", "FONT")
    curve.body = text
    curve.size = LABEL_SIZE
    curve.offset = LABEL_SIZE * 0.012  # a little bolder
    curve.align_x, curve.align_y = "CENTER", "BOTTOM"
    label = bpy.data.objects.new("Label", curve)
    label.rotation_euler.x = math.pi / 2 - ELEVATION
    scene.collection.objects.link(label)
    return label
