# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the ticks of Live take; run by scripts/benchmark_live.py.

For a coarse monkey and each mesh in /share it drags the slider for ten seconds. It writes what each
tick took, how long each change took to be seen, and how many iterations were done, to
/share/ticks.json; and how long it took in ticks until a new object has followed what was moved on
its original, to /share/strokes.json. Blender's own drawing is not part of the ticks.
"""

import importlib
import json
import os
import pathlib
import sys
import time

import bmesh
import bpy
import guidrive as gui
import live_scene as scene
import numpy as np

SECONDS = 10.0
STROKES, TOUCHED, FAR = 15, 0.02, 0.02
"""how many strokes, which part of the vertices one moves, and how far, of the size"""
FOLDER = pathlib.Path(os.environ.get("BENCH_FOLDER", "/share"))


class Stopwatch:
    """Times every tick of a session, and what passes from a change until it is seen.

    A delay is counted twice: with what Blender does between the ticks (drawing in software, here),
    and as the sum of the ticks alone.
    """

    def __init__(self, session):
        self.ticks, self.delays, self.delays_of_ticks = [], [], []
        self._session, self._changed_at, self._ticks_since = session, None, 0.0
        self._tick, session.tick = session.tick, self.tick
        self._show, session._show = session._show, self.show
        self._is_seen = False

    def changed(self):
        if self._changed_at is None:
            self._changed_at, self._ticks_since = time.perf_counter(), 0.0

    def show(self, objects):
        before = scene.positions(next(iter(objects.values())).name)
        self._show(objects)
        self._is_seen = scene.positions(next(iter(objects.values())).name) != before

    def tick(self, context):
        begin = time.perf_counter()
        self._is_seen = False
        self._tick(context)
        end = time.perf_counter()
        self.ticks.append(end - begin)
        self._ticks_since += end - begin
        if self._is_seen and self._changed_at is not None:
            self.delays.append(end - self._changed_at)
            self.delays_of_ticks.append(self._ticks_since)
            self._changed_at = None


class Counter:
    """Counts the iterations of the extension's solver."""

    def __init__(self):
        # The extension imports it at its first use, which is later.
        [package] = [name for name in sys.modules if name.endswith(".cubic_craft.solver")]
        solver = importlib.import_module(f"{package}.stylization").Stylization
        self.iterations = 0
        self._global_step = solver.global_step
        solver.global_step = lambda stylization: self.count(stylization)

    def count(self, stylization):
        self.iterations += 1
        self._global_step(stylization)


def load(path, cuts):
    """Make the scene hold nothing but the mesh of a file, or a monkey subdivided so many times.

    The edges of a file's mesh are then cut so many times.
    """
    if isinstance(path, int):
        scene.add_monkey(path)
        return bpy.context.object
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        read = bpy.ops.wm.ply_import if path.suffix == ".ply" else bpy.ops.wm.obj_import
        read(filepath=str(path))
        obj = bpy.context.selected_objects[0]
        bpy.context.view_layer.objects.active = obj
        size = max(obj.dimensions)
        obj.scale = (3 / size,) * 3
        if cuts:
            obj.modifiers.new("Cuts", "SUBSURF").subdivision_type = "SIMPLE"
            obj.modifiers["Cuts"].levels = cuts
            bpy.ops.object.modifier_apply(modifier="Cuts")
        bpy.ops.ed.undo_push(message="Load")
    return obj


def measure(path, counter, cuts=0):
    obj = load(path, cuts)
    name, vertices = obj.name, len(obj.data.vertices)
    yield from gui.wait_redraw()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from scene.wait_idle()
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    watch = Stopwatch(scene.live().current())
    properties = bpy.context.window_manager.cubic_craft_live
    last, begin = properties.cubeness, time.monotonic()
    counter.iterations = 0
    ends = 0.2, 0.8
    while time.monotonic() - begin < SECONDS:
        drag = gui.drag(slider.at(ends[0]), slider.at(ends[1]), steps=24)
        ends = ends[::-1]
        for turn in drag:
            if properties.cubeness != last:
                last = properties.cubeness
                watch.changed()
            yield turn
    done = counter.iterations
    seconds = time.monotonic() - begin
    yield from gui.screenshot(f"{name}.png")
    yield from scene.press("ESC")
    yield from gui.wait_until(scene.is_over, what="the end")
    return {
        "mesh": name,
        "vertices": vertices,
        "ticks": watch.ticks,
        "seconds": seconds,
        "iterations_per_second": done / seconds,
        "iterations_per_second_of_ticks": done / sum(watch.ticks),
        "delays": watch.delays,
        "delays_of_ticks": watch.delays_of_ticks,
    }


def stroke(obj, number):
    """Move the vertices around one of them along its normal, in the mode that the object is in."""
    mesh = obj.data
    edited = bmesh.from_edit_mesh(mesh) if obj.mode == "EDIT" else None
    vertices = edited.verts if edited else mesh.vertices
    points = np.array([vertex.co for vertex in vertices])
    if edited:
        edited.verts.ensure_lookup_table()
    middle = vertices[number * len(vertices) // STROKES]
    away = np.linalg.norm(points - np.array(middle.co), axis=1)
    near = np.argsort(away)[: max(int(TOUCHED * len(points)), 1)]
    move = np.array(middle.normal) * FAR * np.ptp(points, axis=0).max()
    points[near] += move * (1.0 - away[near] / away[near].max())[:, None]
    if edited:
        for index in near.tolist():
            edited.verts[index].co = points[index]
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    else:
        mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
        mesh.update()


def follow(path, mode, cuts):
    """Return how long the new object of Live took, in ticks, to follow each stroke."""
    obj = load(path, cuts)
    name, follower = obj.name, f"{obj.name} Cubic"
    scene.settings(name).result = "NEW_OBJECT"
    yield from gui.wait_redraw()
    yield from scene.start_live_beside()
    yield from scene.wait_idle()
    with gui.in_region():
        bpy.ops.object.mode_set(mode=mode)
    yield from scene.wait_idle()
    session = scene.live().current()
    spent, tick = [0.0], session.tick

    def timed(context):
        begin = time.perf_counter()
        tick(context)
        spent[0] += time.perf_counter() - begin

    session.tick = timed
    delays = []
    for number in range(STROKES):
        before, spent[0] = scene.positions(follower), 0.0
        stroke(bpy.data.objects[name], number)
        yield from gui.wait_until(
            lambda before=before: scene.positions(follower) != before, what="the stroke"
        )
        delays.append(spent[0])
        yield from scene.wait_idle()
    with gui.in_region():
        bpy.ops.object.mode_set(mode="OBJECT")
    vertices = len(bpy.data.objects[name].data.vertices)
    yield from scene.press("ESC")
    yield from gui.wait_until(scene.is_over, what="the end")
    return {"mesh": name, "vertices": vertices, "mode": mode, "delays": delays}


def test():
    gui.simplify_viewport()
    rows, counter = [], Counter()
    paths = sorted([*FOLDER.glob("*.obj"), *FOLDER.glob("*.ply")])
    for path in (1, *(paths or (2, 3))):  # the first is coarse, and is refined
        rows.append((yield from measure(path, counter)))
    if paths:
        rows.append((yield from measure(paths[-1], counter, cuts=1)))  # a large one
    (FOLDER / "ticks.json").write_text(json.dumps(rows))
    strokes = []
    for mode in ("OBJECT", "EDIT"):
        strokes.append((yield from follow(paths[-1] if paths else 3, mode, cuts=0)))
    (FOLDER / "strokes.json").write_text(json.dumps(strokes))


gui.run(test)
