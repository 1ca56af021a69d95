# SPDX-License-Identifier: GPL-3.0-or-later
"""What another Blender does to a file, in a process of its own: visit.py WHAT FILE [ZIP].

``make``: a cubified monkey and one with the shape key, with what they were like before;
``save``: opened and saved, nothing else;
``restore``: check that each bit comes back, then cubify again and save.
Without a ZIP that Blender does not have the extension.
"""

import os
import sys
import tempfile

os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="cubic_craft_visit_")

import bpy
import numpy as np

RESULTS = ("MESH", "SHAPE_KEY")


def bits(mesh):
    values = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", values)
    return values.tobytes().hex()


def run(operator, obj, **options):
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    assert operator(**options) == {"FINISHED"}


def make():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    for result in RESULTS:
        bpy.ops.mesh.primitive_monkey_add()
        obj = bpy.context.object
        obj.name = result
        obj["before"] = bits(obj.data)
        group = obj.vertex_groups.new(name="Ear")
        group.add(range(40), 1.0, "REPLACE")
        obj.cubic_craft.handles.add().group = "Ear"
        obj.cubic_craft.orientation = (0.1, 0.2, 0.3)
        run(bpy.ops.cubic_craft.cubify, obj, result=result, cubeness=0.75, max_iterations=5)
        obj["after"] = bits(obj.data)


def restore():
    for result in RESULTS:
        obj = bpy.data.objects[result]
        settings = obj.cubic_craft
        assert bits(obj.data) == obj["after"]
        assert abs(settings.cubeness - 0.75) < 1e-6 and settings.result == result
        assert abs(settings.orientation[1] - 0.2) < 1e-6, tuple(settings.orientation)
        assert [handle.group for handle in settings.handles] == ["Ear"]
        run(bpy.ops.cubic_craft.restore, obj)
        assert bits(obj.data) == obj["before"] and obj.data.shape_keys is None
        assert not [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]
        run(bpy.ops.cubic_craft.cubify, obj, max_iterations=5)
        assert bits(obj.data) != obj["before"] or result == "SHAPE_KEY"


def main(what, file, archive=None):
    if archive:
        bpy.ops.extensions.package_install_files(
            filepath=archive, repo="user_default", enable_on_install=True
        )
    if what == "make":
        make()
    else:
        bpy.ops.wm.open_mainfile(filepath=file)
    if what == "restore":
        restore()
    bpy.ops.wm.save_as_mainfile(filepath=file)
    print("done in", bpy.app.version_string, flush=True)
    os._exit(0)  # Blender 4.2 crashes while it is freed


if __name__ == "__main__":
    main(*sys.argv[1:])
