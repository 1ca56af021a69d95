# SPDX-License-Identifier: GPL-3.0-or-later
"""Light, floor, camera and materials of the picture."""

import math
from typing import Any, cast

import bpy
from mathutils import Euler, Vector

from .gallery import ELEVATION, Gallery

FINISHES = {
    "clay": ((0.56, 0.20, 0.09), 0.55),
    "teal": ((0.012, 0.27, 0.235), 0.42),
    "grey": ((0.25, 0.25, 0.245), 0.55),
    "green": ((0.075, 0.23, 0.05), 0.42),
}
"""name: linear RGB, roughness; headless pictures show clay and teal, the paper's gray and green"""
INK = (0.05, 0.045, 0.04)
FLOOR_NEAR = (0.80, 0.75, 0.68)
FLOOR_FAR = (0.36, 0.34, 0.32)
"""linear RGB"""

MARGIN = 1.04
"""how much wider the picture is than what it must show"""
SHARP_ANGLE = math.radians(35.0)
"""between faces of meshes that came without normals"""

LIGHTS = (
    # name, direction (azimuth and elevation in degrees, 0 is the camera), strength, angular size
    ("Key", (58.0, 44.0), 4.2, 12.0, (1.0, 0.95, 0.88)),
    ("Fill", (-62.0, 22.0), 0.4, 60.0, (0.82, 0.91, 1.0)),
    ("Rim", (-150.0, 36.0), 2.2, 20.0, (1.0, 0.97, 0.93)),
)


def furnish(gallery: Gallery, aspect: float) -> None:
    """Add everything to the gallery's scene that a picture of that width by height needs."""
    _lights(gallery.scene)
    _floor(gallery)
    _camera(gallery, aspect)
    _materials(gallery)


def _lights(scene: bpy.types.Scene) -> None:
    # Suns light every copy alike, however wide the gallery is.
    for name, (azimuth, elevation), strength, size, color in LIGHTS:
        turn = Euler((math.radians(90.0 - elevation), 0.0, math.radians(azimuth)))
        add_sun(scene, name, turn, strength, size).color = color
    light_around(scene, (0.93, 0.96, 1.0), 0.22)


def add_sun(
    scene: bpy.types.Scene, name: str, turn: Euler, strength: float, size: float
) -> bpy.types.Light:
    """Add a sun, of a size in degrees, that shines down its Z axis, turned so; return it."""
    light = cast("bpy.types.SunLight", bpy.data.lights.new(name, "SUN"))
    light.energy, light.angle = strength, math.radians(size)
    lamp = bpy.data.objects.new(name, light)
    lamp.rotation_euler = turn
    scene.collection.objects.link(lamp)
    return light


def light_around(
    scene: bpy.types.Scene, color: tuple[float, float, float], strength: float
) -> None:
    """Give the scene light (linear RGB) from all sides."""
    scene.world = bpy.data.worlds.new("World")
    background = _nodes(scene.world)["Background"]
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = strength


def _floor(gallery: Gallery) -> None:
    far = 100.0 * max(gallery.width, gallery.height)
    mesh = bpy.data.meshes.new("Floor")
    mesh.from_pydata(
        [(-far, -far, 0.0), (far, -far, 0.0), (far, far, 0.0), (-far, far, 0.0)], [], [(0, 1, 2, 3)]
    )
    material = surface("Floor", FLOOR_NEAR, roughness=0.9)
    mesh.materials.append(material)
    gallery.scene.collection.objects.link(bpy.data.objects.new("Floor", mesh))

    nodes, links = material.node_tree.nodes, material.node_tree.links
    place = nodes.new("ShaderNodeTexCoord")
    pool = nodes.new("ShaderNodeMapping")
    pool.inputs["Scale"].default_value = (
        1.0 / gallery.width,
        math.sin(ELEVATION) / gallery.height * 0.75,
        0.0,
    )
    distance = nodes.new("ShaderNodeTexGradient")
    distance.gradient_type = "QUADRATIC_SPHERE"
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = (*FLOOR_FAR, 1.0)
    ramp.color_ramp.elements[1].color = (*FLOOR_NEAR, 1.0)
    links.new(place.outputs["Object"], pool.inputs["Vector"])
    links.new(pool.outputs["Vector"], distance.inputs["Vector"])
    links.new(distance.outputs["Fac"], ramp.inputs["Fac"])
    links.new(ramp.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])


def _camera(gallery: Gallery, aspect: float) -> None:
    # Without perspective all copies are seen from the same side and in the same size.
    data = bpy.data.cameras.new("Camera")
    data.type = "ORTHO"
    data.sensor_fit = "HORIZONTAL"
    data.ortho_scale = max(gallery.width, gallery.height * aspect) * MARGIN
    distance = 10.0 * max(gallery.width, gallery.height)
    data.clip_end = 100.0 * distance
    camera = bpy.data.objects.new("Camera", data)
    camera.rotation_euler.x = math.pi / 2 - ELEVATION
    backward = Vector((0.0, -math.cos(ELEVATION), math.sin(ELEVATION)))
    camera.location = gallery.center + backward * distance
    gallery.scene.collection.objects.link(camera)
    gallery.scene.camera = camera


def _materials(gallery: Gallery) -> None:
    """Give each group its finish, unless a mesh has materials of its own."""
    ink = surface("Ink", INK, roughness=1.0)
    for obj in gallery.scene.objects:
        if obj.type == "FONT":
            obj.data.materials.append(ink)
            obj.visible_shadow = False
            obj.display.show_shadows = False
    used = dict.fromkeys(gallery.finishes)
    finishes = {name: surface(name.capitalize(), *FINISHES[name]) for name in used}
    for finish, turntable in zip(gallery.finishes, gallery.turntables, strict=True):
        for copy in turntable.children:
            mesh = copy.data
            _shade(mesh)
            if not any(slot.material for slot in copy.material_slots):
                mesh.materials.clear()
                mesh.materials.append(finishes[finish])


def _shade(mesh: bpy.types.Mesh) -> None:
    """Smooth a mesh that came without normals; what has some keeps its look."""
    is_flat = not any(polygon.use_smooth for polygon in mesh.polygons)
    if is_flat and not mesh.has_custom_normals:
        mesh.shade_smooth()
        mesh.set_sharp_from_angle(angle=SHARP_ANGLE)


def surface(name: str, color: tuple[float, float, float], roughness: float) -> Any:
    """Return a new material of one color (linear RGB), without gloss at roughness 1."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = (*color, 1.0)  # what Workbench shows
    material.roughness = roughness
    shader = _nodes(material)["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return material


def _nodes(owner: bpy.types.World | bpy.types.Material) -> Any:
    """Nodes of a world or material, made if Blender (before 5.0) has not yet done so."""
    if owner.node_tree is None:
        owner.use_nodes = True
    return owner.node_tree.nodes
