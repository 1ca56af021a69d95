# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings as Blender properties: on every object, and on the operator."""

from dataclasses import fields
from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    BoolVectorProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..form import properties as form_properties
from ..handles import Handle
from ..handles.pose import object_handles
from ..handles.properties import CubicCraftHandle
from ..mesh_bridge import KINDS, last_run
from ..object_properties import PROPERTY, object_properties
from ..presets.selector import preset_property
from ..regions.properties import CubicCraftRegion
from ..regions.region import Region, object_regions
from ..screen import glimpse
from .values import Settings

_SPACES = (
    (
        "OBJECT",
        "Object",
        "The angles are relative to the object's own axes, so the form rotates with the object",
    ),
    (
        "WORLD",
        "World",
        "The angles are relative to the world axes, however the object is rotated",
    ),
    ("FRAME", "Frame", "The angles are relative to the axes of another object"),
)
_RESULTS = (
    ("MESH", "Mesh", "Move the vertices of the mesh; Restore brings back the original"),
    ("SHAPE_KEY", "Shape Key", 'Write a shape key "Cubic" that can be adjusted and animated'),
    ("NEW_OBJECT", "New Object", "Make a cubic copy and leave the object unchanged"),
)
_TOGETHER = (
    ("OFF", "Off", "Each part becomes cubic on its own, whatever it touches"),
    ("PARTS", "Parts", "The parts of a mesh stay together, such as eyes in their sockets"),
    (
        "SELECTION",
        "Selection",
        "Meshes that are selected together also stay together, such as clothes on a body",
    ),
)
_FLOOR = (
    (
        "AUTO",
        "What Stands",
        "All feet, paws, wheels and legs, or a wide base, if parts may not turn",
    ),
    ("ON", "Lowest Point", "Whatever is lowest, such as a ball, and all that stands"),
    ("OFF", "Off", "Nothing"),
)
_REFINEMENTS = (
    (
        "AUTO",
        "Auto",
        "Solve a coarse mesh as if it were finer, so that it becomes as cubic as a dense one; it"
        " keeps its own vertices",
    ),
    ("OFF", "Off", "Solve the mesh as it is"),
)
# The numbers are in files. 0 was Auto, which Blender reads as the default.
_ROTATIONS = (
    ("KEEP", "No", "No part turns or leans as a whole: upright parts stay upright", 1),
    ("FREE", "Yes", "A part may turn by some degrees, to fit the cube a little better", 2),
)
_DEVICES = (
    ("AUTO", "Auto", "Taichi or Quadrants on the processor if it is installed, otherwise NumPy"),
    ("CPU", "CPU", "Taichi or Quadrants on the processor"),
    ("GPU", "GPU", "Taichi or Quadrants on the graphics card"),
    ("NUMPY", "NumPy", "Neither Taichi nor Quadrants: slower, but works everywhere"),
)


_LISTS = ("handles", "regions")


def _status(properties):
    """Return the status of the mesh, which several objects may share."""
    run = last_run(properties.id_data)
    return run.status if run else ""


# The numbers are in files. Who sculpts on a result and then moves a slider wants to keep both.
_STARTS = (
    (
        "EDITS",
        "Original and Edits",
        "Start from the original, and put what you moved by hand back onto the result",
        2,
    ),
    (
        "HERE",
        "From Here",
        "Start from the mesh as it is now, which replaces the original; Restore First brings the"
        " first one back until Apply",
        0,
    ),
    ("ORIGINAL", "From the Original", "Start from the original; edits by hand are lost", 1),
)
_OPTIONS = form_properties.OPTIONS


class StartProperty:
    """Mixin of the property that the operator and the object share, but not Live and presets.

    Each object keeps its own for one run: on a mesh that is edited again, a click must neither
    discard nor replace anything without being asked to.
    """

    start: EnumProperty(
        name="Start",
        description="What Cubify and Live start from if the mesh was edited by hand since it"
        " was cubified",
        items=_STARTS,
        default=Settings.start,
        options={"SKIP_SAVE"},
    )


class RunProperties:
    """Mixin of all settings that the operator and the object share.

    SKIP_SAVE concerns the operator only: its values come from the object, not from its last run.
    """

    cubeness: form_properties.cubeness()
    crispness: FloatProperty(
        name="Crispness",
        description="How far the sides of the cubic shape are made flat and its edges straight."
        " 0 is soft, 1 is cut as with a knife; details stay on the sides",
        default=Settings.crispness,
        min=0.0,
        max=1.0,
        step=1,
        precision=3,
        options=_OPTIONS,
    )
    form: form_properties.form()
    form_sides: form_properties.form_sides()
    form_weights: form_properties.form_weights()
    capture_strength: FloatProperty(
        name="Strength",
        description="How strongly the surface turns as the normal capture shows, in addition to the"
        " cubeness. You can type values beyond the slider, up to 10",
        default=Settings.capture_strength,
        min=0.0,
        max=10.0,
        soft_max=1.0,
        step=1,
        precision=3,
        options=_OPTIONS,
    )
    form_directions: StringProperty(
        name="Directions",
        description="Directions that the sides of the form face, in its own axes: three numbers for"
        ' each, such as "0 0 1, 1 0 0". Directions from Selection writes them',
        options=_OPTIONS,
    )
    orientation: form_properties.orientation(glimpse.on_turn)
    space: EnumProperty(
        name="Relative To",
        description="Axes that the rotation of the form is relative to",
        items=_SPACES,
        default=Settings.space,
        options=_OPTIONS,
    )
    use_handles: BoolProperty(
        name="Handles",
        description="Hold and pose the vertices of the object's handles",
        default=True,
        options=_OPTIONS,
    )
    use_regions: BoolProperty(
        name="Regions",
        description="Use the object's regions: vertex groups with a form of their own",
        default=True,
        options=_OPTIONS,
    )
    map_group: StringProperty(
        name="Vertex Group",
        description="Vertex group whose weights scale the cubeness",
        options=_OPTIONS,
    )
    map_invert: BoolProperty(
        name="Invert",
        description="Invert the influence of the vertex group",
        default=Settings.map_invert,
        options=_OPTIONS,
    )
    result: EnumProperty(
        name="Write To",
        description="Where to write the cubic shape",
        items=_RESULTS,
        default=Settings.result,
        options=_OPTIONS,
    )
    with_modifiers: BoolProperty(
        name="With Modifiers",
        description="Apply the modifiers to the new object, including the pose of an Armature."
        " When off, the mesh without its modifiers becomes cubic",
        default=Settings.with_modifiers,
        options=_OPTIONS,
    )
    solidity: FloatProperty(
        name="Solidity",
        description="How firmly limbs, necks and walls keep their thickness, and bodies their"
        " volume. At 0 the mesh is a hollow surface that may fold flat; higher values are"
        " less cubic",
        default=Settings.solidity,
        min=0.0,
        max=10.0,
        soft_max=1.0,
        step=1,
        precision=3,
        options=_OPTIONS,
    )
    keep_pose: BoolProperty(
        name="Keep Pose",
        description="Turn limbs into boxes along themselves, so that a raised arm stays raised."
        " When off, limbs turn toward the sides of the form too",
        default=Settings.keep_pose,
        options=_OPTIONS,
    )
    detail: FloatProperty(
        name="Detail",
        description="Features smaller than this, such as noses and toes, ride along instead of"
        " being flattened. It is a share of the largest dimension: 0.05 is a twentieth, and 0"
        " flattens everything",
        default=Settings.detail,
        min=0.0,
        max=1.0,
        soft_max=0.2,
        step=1,
        precision=3,
        options=_OPTIONS,
    )
    detail_strength: FloatProperty(
        name="Detail Strength",
        description="How high details stand out: 0 leaves a smooth sculpture, 1 keeps them as they"
        " are, more exaggerates them",
        default=Settings.detail_strength,
        min=0.0,
        max=10.0,
        soft_max=2.0,
        step=1,
        precision=3,
        options=_OPTIONS,
    )
    detail_group: StringProperty(
        name="Detail Group",
        description="Vertex group whose weights scale the strength of details, such as of a face",
        options=_OPTIONS,
    )
    keep_apart: BoolProperty(
        name="Keep Apart",
        description="Keep surfaces from growing into each other, such as fingers side by side."
        " Those that already cross are not changed by this",
        default=Settings.keep_apart,
        options=_OPTIONS,
    )
    together: EnumProperty(
        name="Keep Together",
        description="What moves along with the parts it touches: eyes with the head, buttons with"
        " the coat",
        items=_TOGETHER,
        default=Settings.together,
        options=_OPTIONS,
    )
    refine: EnumProperty(
        name="Refine",
        description="How to solve meshes with few vertices",
        items=_REFINEMENTS,
        default=Settings.refine,
        options=_OPTIONS,
    )
    rotation: EnumProperty(
        name="Parts May Turn",
        description="Whether parts may turn as a whole to fit the cube. Parts with handles are not"
        " affected",
        items=_ROTATIONS,
        default=Settings.rotation,
        options=_OPTIONS,
    )
    symmetry: BoolVectorProperty(
        name="Symmetry",
        description="Keep halves that mirror each other about the object's origin exactly"
        " symmetric. A Mirror modifier does not need this",
        subtype="XYZ",
        default=Settings.symmetry,
        options=_OPTIONS,
    )
    keep_symmetric: BoolProperty(
        name="Keep Symmetric",
        description="A mesh of which 99 % mirror each other about its origin, along X, Y or Z,"
        " stays symmetric, if its form and weights are, too. So do objects solved together, such as"
        " a body with clothes and eyes, about the plane that they share",
        default=Settings.keep_symmetric,
        options=_OPTIONS,
    )
    hold_rest: BoolProperty(
        name="Hold the Rest",
        description="Where no handle is pinned, keep regions far from the moved handles in place"
        " as a whole; they still become cubic. When off, they move along",
        default=Settings.hold_rest,
        options=_OPTIONS,
    )
    floor: EnumProperty(
        name="Keep on Floor",
        description="What keeps its height in the world, except for parts held by handles or the"
        " cubeness map",
        items=_FLOOR,
        default=Settings.floor,
        options=_OPTIONS,
    )
    device: EnumProperty(
        name="Device",
        description="Library and hardware to compute with",
        items=_DEVICES,
        default=Settings.device,
        options=_OPTIONS,
    )
    max_iterations: IntProperty(
        name="Max Iterations",
        description="Stop after this many iterations, even if not converged",
        default=Settings.max_iterations,
        min=1,
        soft_max=5000,
        options=_OPTIONS,
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Stop when an iteration moves no vertex by more than this fraction of the"
        " largest distance from the original, and the energy no longer falls",
        default=Settings.tolerance,
        min=1e-9,
        max=1.0,
        precision=6,
        options=_OPTIONS,
    )


def _may_be_capture(properties, obj):
    """Return whether an object may be the normal capture of the one with the properties."""
    return obj.type in KINDS and obj != properties.id_data


class CubicCraftProperties(StartProperty, RunProperties, bpy.types.PropertyGroup):
    """The settings of an object, saved with it."""

    preset: preset_property()
    frame: PointerProperty(
        name="Frame",
        description="Object whose axes the form uses",
        type=bpy.types.Object,
    )
    form_object: form_properties.form_object()
    capture_object: PointerProperty(
        name="Normal Capture",
        description="Ball that you have shaped. Its normals show how the surfaces of the mesh turn:"
        " each as the ball did where it faced the same direction",
        type=bpy.types.Object,
        poll=_may_be_capture,
    )
    handles: CollectionProperty(name="Handles", type=CubicCraftHandle)
    active_handle: IntProperty(
        name="Active Handle",
        description="Index of the handle that the buttons act on",
        min=0,
        options=set(),
    )
    regions: CollectionProperty(name="Regions", type=CubicCraftRegion)
    active_region: IntProperty(
        name="Active Region",
        description="Index of the region that the buttons act on",
        min=0,
        options=set(),
    )
    is_target: BoolProperty(
        name="Target",
        description="A handle follows this object, or did so before",
    )
    is_made_target: BoolProperty(
        name="Made as Target",
        description="This object was made for a handle and is removed with it",
    )
    status: StringProperty(
        name="Last Run",
        description="Summary of the run that made the shape of the mesh",
        get=_status,
    )


def value_of(properties: Any, name: str) -> Any:
    """Return a property of a property group, or of an operator, as a plain value.

    An enum with a number that no longer has an item, from an older file, has its default.
    """
    value = getattr(properties, name)
    if value == "" and isinstance(getattr(Settings, name, None), str):
        return getattr(Settings, name)
    return value if isinstance(value, str | int | float | bpy.types.ID | None) else tuple(value)


def settings_of(
    obj: bpy.types.Object,
    handles: tuple[Handle, ...] | None = None,
    regions: tuple[Region, ...] | None = None,
) -> Settings:
    """Return the object's settings as plain values.

    Parameters
    ----------
    obj
    handles : tuple of Handle, optional
        Instead of the object's own.
    regions : tuple of Region, optional
        Likewise.

    Raises
    ------
    CubicCraftError
        The object's own handles or regions cannot be used, see `object_handles` and
        `object_regions`.
    """
    p = object_properties(obj)
    if handles is None:
        handles = object_handles(obj)
    if regions is None:
        regions = object_regions(obj) if p.use_regions else ()
    names = [field.name for field in fields(Settings) if field.name not in _LISTS]
    values = {name: value_of(p, name) for name in names}
    return Settings(handles=handles, regions=regions, **values)


def register():
    """Add `Object.cubic_craft`."""
    bpy.utils.register_class(CubicCraftProperties)
    setattr(bpy.types.Object, PROPERTY, PointerProperty(type=CubicCraftProperties))


def unregister():
    """Remove `Object.cubic_craft`; the values stay in the file."""
    delattr(bpy.types.Object, PROPERTY)
    bpy.utils.unregister_class(CubicCraftProperties)
