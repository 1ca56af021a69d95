# SPDX-License-Identifier: GPL-3.0-or-later
"""Hypothesis strategies for objects with a hostile mesh, and for what Cubify is asked to do."""

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from hostile_meshes import SEEDS, broken_meshes
from hypothesis import strategies as st
from mathutils import Matrix
from rich_mesh import position_of, set_points
from worth_trying import values

from solver.method import SETTINGS
from solver.styles.form_names import FORMS, OF_OBJECT

TRANSFORMS = {
    "none": Matrix(),
    "moved and turned": Matrix.Translation((1e3, -5, 2)) @ Matrix.Rotation(0.7, 4, (1, 2, 3)),
    "mirrored": Matrix.Diagonal((-1, 1, 1, 1)),
    "uneven": Matrix.Diagonal((0.01, 3, 100, 1)),
    "sheared": Matrix.Shear("XY", 4, (0.8, -1.5)) @ Matrix.Rotation(0.4, 4, "X"),
    "turned inside out": Matrix.Diagonal((-2, -1, -0.5, 1)),
    "flat": Matrix.Diagonal((1, 1, 0, 1)),
    "a line": Matrix.Diagonal((0, 1, 0, 1)),
    "nothing": Matrix.Diagonal((0, 0, 0, 1)),
    "nearly flat": Matrix.Diagonal((1, 1, 1e-7, 1)),
    "tiny": Matrix.Scale(1e-12, 4),
    "huge": Matrix.Scale(1e12, 4),
    "not finite": Matrix.Diagonal((1, float("nan"), 1, 1)),
}
"""world matrices"""
POSES = {
    "held": Matrix(),
    "moved": Matrix.Translation((0.3, 0.1, -2)),
    "mirrored": Matrix.Diagonal((1, -1, 1, 1)),
    "collapsed": Matrix.Diagonal((0, 0, 0, 1)),
    "far": Matrix.Translation((1e6, 0, 0)),
}
"""matrices of handles"""
OPTIONS = {name: values(each) for name, each in SETTINGS.items()} | {
    "form": [each for each, *_ in FORMS if each not in (*OF_OBJECT, "FACES")],
    "result": ["MESH", "SHAPE_KEY", "NEW_OBJECT"],
    "map_group": ["", "Map"],
    "device": ["CPU", "CPU", "NUMPY"],
    "max_iterations": [3],
}
"""values of the settings"""


@dataclass
class Asked:
    """What Cubify is asked to do, with which object."""

    mesh: Any
    """BrokenMesh"""
    transform: str
    seed: int
    keys: int
    spoilt: str
    options: dict[str, Any]
    pose: str

    def __repr__(self):
        """Tell how it was made."""
        kinds = f"transform {self.transform}, seed {self.seed}, keys {self.keys}"
        return f"<{self.mesh}, {kinds}, spoilt {self.spoilt}, pose {self.pose}, {self.options}>"

    def _repr_pretty_(self, printer, cycle):
        printer.text(repr(self))  # Hypothesis would print all fields


@st.composite
def asked(draw):
    """Draw an object and what Cubify is asked to do with it."""
    options = {name: draw(st.sampled_from(each)) for name, each in OPTIONS.items()}
    return Asked(
        draw(broken_meshes(for_blender=True)),
        draw(st.sampled_from(sorted(TRANSFORMS))),
        draw(SEEDS),
        draw(st.integers(0, 2)),
        draw(st.sampled_from([*10 * ["no"], "nan", "infinity", "key", "empty group", "hidden"])),
        options,
        draw(st.sampled_from(["none", "none", *POSES])),
    )


def add_object(case):
    """Add the object of an `Asked` to the scene, with everything on it that must stay."""
    rng = np.random.default_rng(case.seed)
    mesh = bpy.data.meshes.new("Hostile")
    mesh.from_pydata(case.mesh.V.tolist(), case.mesh.edges, case.mesh.faces)
    obj: Any = bpy.data.objects.new("Hostile", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    obj.parent = bpy.data.objects.new("Parent", None)
    obj.matrix_parent_inverse = TRANSFORMS[case.transform]  # an object's own has no shear
    _add_data(obj, rng)
    for number in range(case.keys and case.keys + 1):
        key = obj.shape_key_add(name=f"Key {number}", from_mix=False)
        if number:
            offsets = rng.normal(size=case.mesh.V.shape) * np.ptp(case.mesh.V) * 0.1
            set_points(mesh, key.name, case.mesh.V + offsets)
            key.value = 0.5
    _spoil(obj, case.spoilt, rng)
    bpy.context.view_layer.update()
    return obj


def frame_object():
    """Add an object whose axes are those of the cube, scaled unevenly and mirrored."""
    frame = bpy.data.objects.new("Frame", None)
    bpy.context.collection.objects.link(frame)
    turn = Matrix.Rotation(0.5, 4, (1, 1, 0))
    frame.matrix_world = turn @ Matrix.Diagonal((-1, 2, 1e-3, 1))
    bpy.context.view_layer.update()
    return frame


def _add_data(obj, rng):
    mesh = obj.data
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", rng.random(2 * len(mesh.loops), np.float32))
    colors = mesh.color_attributes.new("Paint", "BYTE_COLOR", "CORNER")
    colors.data.foreach_set("color", rng.random(4 * len(colors.data), np.float32))
    for domain in ("POINT", "EDGE", "FACE"):
        values = mesh.attributes.new(f"heat {domain}", "FLOAT", domain)
        values.data.foreach_set("value", rng.random(len(values.data), np.float32))
    for name in ("Red", "Blue"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons), np.int32))
    for name, share in (("Map", 0.6), ("Pin", 0.2)):
        group = obj.vertex_groups.new(name=name)
        for index in np.flatnonzero(rng.random(len(mesh.vertices)) < share):
            group.add([int(index)], float(rng.random()), "REPLACE")


def _spoil(obj, spoilt, rng):
    mesh = obj.data
    V = position_of(mesh)
    corner = rng.integers(len(V)), rng.integers(3)
    if spoilt in ("nan", "infinity"):
        V[corner] = {"nan": np.nan, "infinity": np.inf}[spoilt]
        mesh.vertices.foreach_set("co", V.ravel())
        if mesh.shape_keys is not None:
            set_points(mesh, mesh.shape_keys.reference_key.name, V)
    elif spoilt == "key" and mesh.shape_keys is not None:
        V[corner] = np.inf
        set_points(mesh, mesh.shape_keys.key_blocks[-1].name, V)
    elif spoilt == "empty group":
        obj.vertex_groups.remove(obj.vertex_groups["Pin"])
        obj.vertex_groups.new(name="Pin")
    elif spoilt == "hidden":
        obj.hide_set(True)
        bpy.context.view_layer.objects.active = obj
