"""Place the original and its cubic versions side by side in a scene of their own.

The meshes are not touched: whatever their size and place, each group (all objects of the input at
one cubeness) hangs on an empty that scales it to the same size and stands it on the floor.
"""

import math
from argparse import Namespace
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from .cubify_all import Sculpture
from .detached import detached_copy
from .extension import Extension

__all__ = ("Gallery", "build_gallery")

SIZE = 2.0
"""largest extent of the original in the gallery; everything else is measured by it"""
GAP = 0.3
"""between two neighbours"""
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
    centre: Vector
    """what the camera looks at"""
    width: float
    height: float
    """of all that the picture must show, along its sides"""


@dataclass
class _Group:
    """The input at one cubeness."""

    label: str
    copies: list[bpy.types.Object]
    places: list[Matrix]
    """where each copy is, stood upright"""
    points: np.ndarray
    """(n,3) of what can be seen, in the space of the places"""
    is_original: bool


def build_gallery(sculptures: list[Sculpture], options: Namespace, extension: Extension) -> Gallery:
    """Build the gallery for the picture's format, with room to turn for a turntable."""
    scene = bpy.data.scenes.new("Gallery")
    bpy.context.window.scene = scene
    groups = _groups(sculptures, options, extension, scene)
    outlines = _outlines(groups, options.turntable > 0)
    labels = [_label(group.label, scene) for group in groups]
    bpy.context.view_layer.update()
    width = max((outlines[:, 1] - outlines[:, 0]).max(), *(label.dimensions.x for label in labels))
    bottom = outlines[:, 2].min() - LABEL_GAP - LABEL_SIZE
    top = outlines[:, 3].max()
    pitch_x, pitch_z = float(width) + GAP, float(top - bottom) + GAP
    columns, rows = _grid(len(groups), pitch_x, pitch_z, *options.resolution)
    centre = UP * ((bottom + top) / 2)
    gallery = Gallery(scene, [], centre, columns * pitch_x, rows * pitch_z)
    for number, (group, outline, label) in enumerate(zip(groups, outlines, labels, strict=True)):
        row, column = divmod(number, columns)
        in_row = min(columns, len(groups) - row * columns)
        x = (column - (in_row - 1) / 2) * pitch_x
        # Rows are apart in the picture; on the floor that takes much more.
        y = ((rows - 1) / 2 - row) * pitch_z / math.sin(ELEVATION)
        axis = Vector((x - (outline[0] + outline[1]) / 2, y, 0.0))
        gallery.turntables.append(_stand(group, groups[0], axis, scene))
        label.location = (x, y + bottom / math.sin(ELEVATION), LABEL_LIFT)
    return gallery


def _groups(
    sculptures: list[Sculpture],
    options: Namespace,
    extension: Extension,
    scene: bpy.types.Scene,
) -> list[_Group]:
    versions = [("original", None)]
    versions += [(f"cubeness {value!r}", number) for number, value in enumerate(options.cubeness)]
    turn = Euler([math.radians(angle) for angle in options.turn]).to_matrix().to_4x4()
    groups = []
    for label, number in versions:
        group = _Group(label, [], [], np.empty((0, 3)), is_original=number is None)
        for sculpture in sculptures:
            original = extension.mesh_bridge.original_positions(sculpture.object.data)
            shape = original if number is None else sculpture.solutions[number].positions
            for user in sculpture.users:
                copy = detached_copy(user, shape, extension, keep_modifiers=True)
                scene.collection.objects.link(copy)
                group.copies.append(copy)
                group.places.append(turn @ user.matrix_world)
        bpy.context.view_layer.update()
        group.points = np.concatenate(
            [_points(*pair) for pair in zip(group.copies, group.places, strict=True)]
        )
        groups.append(group)
    return groups


def _points(copy: bpy.types.Object, place: Matrix) -> np.ndarray:
    """(n,3) vertices of faces as they are rendered, where ``place`` takes them."""
    evaluated = copy.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", points)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    evaluated.to_mesh_clear()
    matrix = np.array(place)
    visible = points.reshape(-1, 3)[np.unique(corners)].astype(np.float64)
    return visible @ matrix[:3, :3].T + matrix[:3, 3]


def _scale(original: _Group) -> float:
    extent = float(np.ptp(original.points, axis=0).max())
    return SIZE / extent if extent > 0.0 else 1.0


def _outlines(groups: list[_Group], turns: bool) -> np.ndarray:
    """(groups,4) left, right, bottom and top of each group in the picture.

    Measured from where its axis meets the floor, along the directions of the picture.
    """
    scale = _scale(groups[0])
    outlines = []
    for group in groups:
        points = (group.points - _foot(group)) * scale
        if turns:
            radius = np.linalg.norm(points[:, :2], axis=1).max()
            rim = radius * math.sin(ELEVATION)
            outlines.append((-radius, radius, -rim, points[:, 2].max() * UP.z + rim))
            continue
        points = points @ np.array(Matrix.Rotation(YAW, 3, "Z")).T
        across, up = points[:, 0], points @ np.array(UP)
        outlines.append((across.min(), across.max(), up.min(), up.max()))
    return np.array(outlines)


def _foot(group: _Group) -> np.ndarray:
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


def _stand(
    group: _Group, original: _Group, place: Vector, scene: bpy.types.Scene
) -> bpy.types.Object:
    """Hang the group on an empty that turns and scales it, and stand it on the floor."""
    turntable = bpy.data.objects.new(group.label, None)
    scene.collection.objects.link(turntable)
    turntable.location = place
    turntable.rotation_euler.z = YAW
    turntable.scale = [_scale(original)] * 3
    to_foot = Matrix.Translation(Vector(-_foot(group)))
    for copy, world in zip(group.copies, group.places, strict=True):
        # The inverse can hold any matrix, also a sheared one; location, rotation and scale cannot.
        own = copy.matrix_world.copy()
        copy.parent = turntable
        copy.matrix_parent_inverse = to_foot @ world @ own.inverted_safe()
    return turntable


def _label(text: str, scene: bpy.types.Scene) -> bpy.types.Object:
    """Stand a line of text on the floor, facing the camera."""
    curve = bpy.data.curves.new("Label", "FONT")
    curve.body = text
    curve.size = LABEL_SIZE
    curve.offset = LABEL_SIZE * 0.012  # a little bolder
    curve.align_x, curve.align_y = "CENTER", "BOTTOM"
    label = bpy.data.objects.new("Label", curve)
    label.rotation_euler.x = math.pi / 2 - ELEVATION
    scene.collection.objects.link(label)
    return label
