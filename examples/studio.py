# SPDX-License-Identifier: GPL-3.0-or-later
"""What the examples share: something to make cubic, and a picture of all that is in the scene."""

import math
import sys
from pathlib import Path

import bmesh
import bpy
from mathutils import Matrix, Vector

WIDTH, HEIGHT = 800, 320  # pixels
SAMPLES = 16
LEVELS = 2  # of the monkey's subdivision
VOXEL = 0.045  # units, of the figure's surface
MARGIN = 1.08  # of the picture around the objects
VIEW = Vector((0.35, -1.0, 0.35)).normalized()  # from the objects to the camera
NEXT = 2.7 * Vector((1.0, 0.35, 0.0)).normalized()  # from one object to the next, across the view
BODY = (  # ends and radius of the body, the head, an arm and a leg; limbs are on both sides
    ((0.0, 0.0, 0.9), (0.0, 0.0, 1.3), 0.26),
    ((0.0, 0.0, 1.85), (0.0, 0.0, 1.9), 0.34),
    ((0.25, 0.0, 1.35), (0.85, 0.0, 1.05), 0.12),
    ((0.16, 0.0, 0.7), (0.28, 0.0, 0.1), 0.14),
)
STEPS = 8  # balls from one end to the other
ORIGIN = Vector()


def empty_scene():
    """Remove everything from the scene."""
    bpy.data.batch_remove(bpy.data.objects)


def monkey(place=ORIGIN):
    """Add a smooth monkey, and return it."""
    bpy.ops.mesh.primitive_monkey_add(location=place)
    obj = bpy.context.object
    obj.modifiers.new("Subdivision", "SUBSURF").levels = LEVELS
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.shade_smooth()
    return obj


def figure(place=ORIGIN):
    """Add a figure with spread arms, made of balls that are melted into one, and return it."""
    mesh = bpy.data.meshes.new("Figure")
    balls = bmesh.new()
    for start, end, radius in BODY:
        for side in (1.0, -1.0):
            for step in range(STEPS + 1):
                x, y, z = Vector(start).lerp(Vector(end), step / STEPS)
                middle = Matrix.Translation((side * x, y, z))
                bmesh.ops.create_icosphere(balls, subdivisions=2, radius=radius, matrix=middle)
    balls.to_mesh(mesh)
    balls.free()
    obj = bpy.data.objects.new("Figure", mesh)
    obj.location = place
    bpy.context.collection.objects.link(obj)
    select([obj])
    obj.modifiers.new("Melt", "REMESH").voxel_size = VOXEL
    obj.modifiers.new("Smooth", "SMOOTH").iterations = 4
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.shade_smooth()
    return obj


def eyes(place=ORIGIN):
    """Add the eyes of the figure as an object of its own, and return it."""
    for side in (-0.13, 0.13):
        middle = place + Vector((side, -0.3, 1.95))
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.08, location=middle)
        bpy.ops.object.shade_smooth()
        bpy.context.object.name = f"Eye {side:+}"
    both = [obj for obj in bpy.data.objects if obj.name.startswith("Eye ")]
    select(both)
    bpy.ops.object.join()
    bpy.context.object.name = "Eyes"
    return bpy.context.object


def select(objects):
    """Select these objects only; the first is the active one."""
    for obj in bpy.context.selected_objects:
        obj.select_set(False)
    for obj in objects:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]


def paint(objects, red, green, blue):
    """Give the objects a color."""
    material = bpy.data.materials.new("Color")
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (red, green, blue, 1.0)
    shader.inputs["Roughness"].default_value = 0.5
    for obj in objects:
        obj.data.materials.clear()
        obj.data.materials.append(material)


def picture_path():
    """Return the file that the command line names behind its ``--``, None if it names none."""
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    return Path(given[0]).resolve() if given else None


def take_picture():
    """Render all objects to the file that the command line names; without one, leave the scene."""
    path = picture_path()
    if path is None:
        return
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.6, 0.6, 0.6, 1.0)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy = 3.0
    sun.rotation_euler = (math.radians(40.0), 0.0, math.radians(50.0))
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type = "ORTHO"
    camera.rotation_euler = VIEW.to_track_quat("Z", "Y").to_euler()
    for obj in (sun, camera):
        scene.collection.objects.link(obj)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.engine = "CYCLES"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = False  # not every Blender has it
    scene.render.image_settings.color_mode = "RGB"
    scene.view_settings.view_transform = "Standard"
    bpy.context.view_layer.update()
    _aim(camera)
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def _aim(camera):
    """Let the camera see all meshes."""
    turn = camera.rotation_euler.to_matrix()
    meshes = [obj for obj in bpy.data.objects if obj.type == "MESH" and not obj.hide_render]
    corners = [obj.matrix_world @ Vector(corner) for obj in meshes for corner in obj.bound_box]
    seen = [turn.transposed() @ corner for corner in corners]
    low = Vector(map(min, zip(*seen, strict=True)))
    high = Vector(map(max, zip(*seen, strict=True)))
    width, height, _ = high - low
    camera.data.ortho_scale = MARGIN * max(width, height * WIDTH / HEIGHT)
    camera.location = turn @ ((low + high) / 2.0) + 50.0 * VIEW
