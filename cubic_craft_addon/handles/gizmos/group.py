# SPDX-License-Identifier: GPL-3.0-or-later
"""The gizmos: a dot on each handle, and arrows, rings and boxes around the active one.

They are Blender's own, so that Shift makes a drag precise, and Esc or right click cancels it.
A gizmo gets its value from us and sets it from the mouse: the values of arrows,
rings and boxes are relative to the start of a drag, those of dots are positions in the world.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ... import live
from ...object_properties import object_properties
from .drag import Drag
from .places import live_object, place_of, places_of

_COLOR, _ACTIVE_COLOR = (1.0, 1.0, 1.0), (1.0, 0.6, 0.15)
_AXIS_COLORS = ((0.96, 0.25, 0.33), (0.55, 0.85, 0.15), (0.2, 0.55, 1.0))
_ALPHA, _ALPHA_HIGHLIGHT = 0.7, 1.0
_DOT_SIZE = 0.11  # of the radius of the rings
_ARROW_START, _BOX_LENGTH = 1.12, 0.7  # of the radius of the rings
_BOX_SIZE = 0.05  # as Blender draws it at the end of a stem of 1
_END_ON = 0.97  # cosine to the view beyond which an arrow cannot be dragged
_EDGE_ON = 0.15  # cosine to the view below which a ring cannot be dragged


@dataclass(frozen=True)
class _Grab:
    gizmo: Any
    number: int
    """of the handle"""
    drag: Drag
    start: np.ndarray
    """(3,) float32, initial position of the handle in the world"""
    size: float
    """radius of the rings in the world"""


class CUBIC_CRAFT_GGT_handles(bpy.types.GizmoGroup):
    """The gizmos of the handles of the active mesh."""

    bl_idname = "CUBIC_CRAFT_GGT_handles"
    bl_label = "CubicCraft Handles"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D", "PERSISTENT"}

    @classmethod
    def poll(cls, context):
        """Return whether a mesh is live, and it or a target of its handles is active."""
        return live_object(context) is not None

    def setup(self, _context):
        """Make the gizmos around the active handle; dots are made when needed."""
        self.grab: _Grab | None = None
        self.value: Any = 0.0
        self.dots: list[Any] = []
        self.arrows = [self._new_arrow("NORMAL", color) for color in _AXIS_COLORS]
        self.rings = [self._new_ring(color) for color in _AXIS_COLORS]
        self.boxes = [self._new_arrow("BOX", color) for color in (*_AXIS_COLORS, _COLOR)]
        for axis in range(3):
            self._tie(self.arrows[axis], partial(self._move, axis))
            self._tie(self.rings[axis], partial(self._turn, axis))
        for axis in range(4):
            self._tie(self.boxes[axis], partial(self._scale, axis))

    def refresh(self, context):
        """Make as many dots as there are handles."""
        obj = live_object(context)
        count = len(object_properties(obj).handles) if obj is not None else 0
        while len(self.dots) < count:
            self.dots.append(self._new_dot(len(self.dots)))

    def draw_prepare(self, context):
        """Move all gizmos to their handles."""
        if self._is_dragging():
            # Blender moves the dragged gizmo; the others would be in the way, or at its old place.
            for gizmo in self.gizmos:
                gizmo.hide = self.grab is not None and gizmo != self.grab.gizmo
            return
        self.grab = None
        obj = live_object(context)
        places = {place.number: place for place in places_of(obj)} if obj else {}
        active = object_properties(obj).active_handle if obj else -1
        for number, dot in enumerate(self.dots):
            dot.hide = number not in places
            _paint(dot, _ACTIVE_COLOR if number == active else _COLOR)
        self._put_around(context, places.get(active))

    def invoke_prepare(self, context, gizmo):
        """Begin a drag: from here on, the gizmo sets the poses."""
        session, obj = live.current(), live_object(context)
        if session is None or obj is None:
            return
        is_dot = gizmo in self.dots
        number = self.dots.index(gizmo) if is_dot else object_properties(obj).active_handle
        place = place_of(obj, number)
        if place is None:
            return
        if is_dot:
            _make_active(obj, number)
        drag = Drag(place.pose, place.world[:3, :3], place.center, _axes(context, place))
        start = place.center_in_world.astype(np.float32)
        size = float(np.linalg.norm(np.array(gizmo.matrix_world)[:3, 2]))
        self.grab, self.value = _Grab(gizmo, number, drag, start, size), 0.0
        session.begin_drag(self._is_dragging)

    # -- values of the gizmos ----------------------------------------------------------------------

    def _place_of_dot(self, number):
        obj = live_object(bpy.context)
        place = place_of(obj, number) if obj is not None else None
        return tuple(place.center_in_world) if place is not None else (0.0, 0.0, 0.0)

    def _move_dot(self, place):
        self._pose(lambda grab: grab.drag.moved(np.float32(place) - grab.start))

    def _move(self, axis, way):
        self._pose(lambda grab: grab.drag.moved(grab.drag.axes[:, axis] * way))

    def _turn(self, axis, angle):
        # Blender's rings count clockwise.
        self._pose(lambda grab: grab.drag.turned(grab.drag.axes[:, axis], -angle))

    def _scale(self, axis, way):
        def scaled(grab):
            factor = 1.0 + way / (grab.size * (_BOX_LENGTH + _BOX_SIZE))
            return grab.drag.scaled([factor if axis in (each, 3) else 1.0 for each in range(3)])

        self._pose(scaled)

    def _pose(self, posed):
        """Set the pose of the handle that is dragged with a function of the drag."""
        obj = live_object(bpy.context)
        if self.grab is None or obj is None:
            return  # Live has ended meanwhile
        handles = object_properties(obj).handles
        if self.grab.number < len(handles):
            live.set_pose(obj, handles[self.grab.number], posed(self.grab))

    def _is_dragging(self):
        try:
            return self.grab is not None and self.grab.gizmo.is_modal
        except ReferenceError:
            return False  # its viewport has been closed

    # -- creating and placing them -----------------------------------------------------------------

    def _new_dot(self, number):
        dot: Any = self.gizmos.new("GIZMO_GT_move_3d")
        dot.draw_style = "RING_2D"
        dot.draw_options = {"FILL", "FILL_SELECT", "ALIGN_VIEW"}
        dot.scale_basis = _DOT_SIZE
        dot.use_draw_modal = True
        _paint(dot, _COLOR)
        dot.target_set_handler(
            "offset", get=partial(self._place_of_dot, number), set=self._move_dot
        )
        return dot

    def _new_arrow(self, style, color):
        arrow: Any = self.gizmos.new("GIZMO_GT_arrow_3d")
        arrow.draw_style = style
        if style == "NORMAL":
            arrow.draw_options = set()
            arrow.length = 0.0
            arrow.use_draw_offset_scale = True
            arrow.matrix_offset = Matrix.Translation((0.0, 0.0, _ARROW_START))
        else:
            arrow.length = _BOX_LENGTH
            arrow.line_width = 2.0
        _paint(arrow, color)
        return arrow

    def _new_ring(self, color):
        ring: Any = self.gizmos.new("GIZMO_GT_dial_3d")
        ring.draw_options = {"CLIP", "ANGLE_VALUE"}
        ring.use_draw_value = True
        ring.line_width = 3.0
        ring.wrap_angle = False
        _paint(ring, color)
        return ring

    def _tie(self, gizmo, tell):
        def take(value):
            self.value = value
            tell(value)

        def give():
            return self.value if self.grab is not None and gizmo == self.grab.gizmo else 0.0

        gizmo.target_set_handler("offset", get=give, set=take)

    def _put_around(self, context, place):
        """Place the arrows, rings and boxes that can be dragged around the active handle."""
        if place is None:
            for gizmo in (*self.arrows, *self.rings, *self.boxes):
                gizmo.hide = True
            return
        center, axes = place.center_in_world, _axes(context, place)
        right, up, view = _view_axes(context, center)
        for number, axis in enumerate(axes.T):
            basis = _matrix(axes[:, (number + 1) % 3], axes[:, (number + 2) % 3], axis, center)
            cosine = abs(float(axis @ view))
            for gizmo in (self.arrows[number], self.rings[number], self.boxes[number]):
                gizmo.matrix_basis = basis
                gizmo.hide = cosine > _END_ON
            self.rings[number].hide = cosine < _EDGE_ON
        diagonal = (right + up) / np.sqrt(2.0)
        self.boxes[3].matrix_basis = _matrix(view, (right - up) / np.sqrt(2.0), diagonal, center)
        self.boxes[3].hide = False


def _make_active(obj, number):
    """Make a handle the active one of the list, as soon as Blender allows writing to objects."""
    uid = obj.session_uid

    def write():
        found = next((other for other in bpy.data.objects if other.session_uid == uid), None)
        if found is not None and object_properties(found).active_handle != number:
            object_properties(found).active_handle = number

    bpy.app.timers.register(write, first_interval=0.0)


def _axes(context, place):
    """Return the axes (3,3) of the arrows as columns, by Blender's Transform Orientation."""
    slot = context.scene.transform_orientation_slots[0]
    return place.own_axes if slot.type == "LOCAL" else np.eye(3)


def _view_axes(context, center):
    """Return the world directions right, up and toward the view at a position."""
    region = context.region_data
    turned = np.array(region.view_matrix.inverted(), dtype=np.float64)
    right, up, view = turned[:3, :3].T
    if region.is_perspective:
        view = turned[:3, 3] - center
        view = view / max(float(np.linalg.norm(view)), 1e-12)
    return right, up, view


def _matrix(x, y, z, place):
    matrix = np.eye(4)
    matrix[:3] = np.column_stack((x, y, z, place))
    return Matrix(matrix.tolist())


def _paint(gizmo, color):
    gizmo.color = color
    gizmo.color_highlight = [(1.0 + value) / 2 for value in color]
    gizmo.alpha, gizmo.alpha_highlight = _ALPHA, _ALPHA_HIGHLIGHT


register, unregister = bpy.utils.register_classes_factory((CUBIC_CRAFT_GGT_handles,))
