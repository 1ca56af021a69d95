# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user does with extensions in Blender's preferences, shown beside the viewport."""

import os
import sys
import tomllib
from pathlib import Path

import bpy
import guidrive as gui

ENGINE = os.environ.get("EXPECT_DEVICE", "").removesuffix("-cpu")
"""the package that has to compute: taichi or quadrants"""
WHERE = {"region_type": "WINDOW", "area_type": "PREFERENCES"}


def open_preferences():
    """Split the viewport and show the extensions in one half."""
    with gui.in_region():
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.55)
    yield from gui.wait_until(
        lambda: sum(area.type == "VIEW_3D" for area in gui.window().screen.areas) == 2,
        what="two viewports",
    )
    views = [area for area in gui.window().screen.areas if area.type == "VIEW_3D"]
    bpy.context.preferences.active_section = "EXTENSIONS"
    max(views, key=lambda area: area.x).type = "PREFERENCES"
    yield from redraw()


def redraw():
    """Let Blender draw the preferences anew."""
    for _ in range(3):
        gui.area("PREFERENCES").tag_redraw()
        yield from gui.wait_redraw()


def press(operator):
    """Click on a button of the preferences, found by its operator."""
    button = yield from gui.find_button(operator, **WHERE)
    yield from gui.click(button)


def drop(path, picture):
    """Do what happens when a zip is dropped on the window, and confirm."""
    yield from gui.move_mouse(gui.viewport_point())
    with gui.in_region():
        bpy.ops.extensions.package_install_files("INVOKE_DEFAULT", url=path)
    for _ in range(20):
        yield
    yield from gui.screenshot(picture)
    yield from gui.keys("RET")


def manifest(repository):
    """Return the manifest of what is installed in a repository; empty if it is not."""
    path = extensions() / repository / "cubic_craft" / "blender_manifest.toml"
    return tomllib.loads(path.read_text()) if path.exists() else {}


def wait_installed(repository, version):
    """Wait until a version with its wheels is installed and enabled."""
    addon = f"bl_ext.{repository}.cubic_craft"
    yield from gui.wait_until(
        lambda: (
            manifest(repository).get("version") == version
            and addon in bpy.context.preferences.addons
            and not gui.running_operators()
        ),
        what=f"version {version}",
    )
    assert {ENGINE, "scipy", "cholespy", "pyamg"} <= unpacked_wheels(), unpacked_wheels()
    assert "numpy" not in unpacked_wheels()
    yield from redraw()


def entry(repository):
    """Return what operators need to find our entry in the list."""
    repos = list(bpy.context.preferences.extensions.repos)
    index = next(i for i, repo in enumerate(repos) if repo.module == repository)
    return {"repo_index": index, "pkg_id": "cubic_craft"}


def open_entry(repository):
    """Show the details of our entry: version, licence, copyright, ..."""
    with gui.in_region(**WHERE):
        assert bpy.ops.extensions.package_show_set(**entry(repository)) == {"FINISHED"}
    yield from redraw()


def remove(repository):
    """Uninstall; nothing of it stays."""
    with gui.in_region(**WHERE):
        done = bpy.ops.extensions.package_uninstall(**entry(repository))
    assert done == {"FINISHED"} and not manifest(repository)
    assert f"bl_ext.{repository}.cubic_craft" not in bpy.context.preferences.addons
    assert not {ENGINE, "scipy"} & unpacked_wheels(), unpacked_wheels()
    assert not hasattr(bpy.types.Object, "cubic_craft")
    yield from redraw()


def cubify(device):
    """Add a monkey and click on Cubify in the sidebar; the device must have done it."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
    view = gui.area().spaces.active.region_3d
    view.view_location.x += 1.2  # out from behind the sidebar
    view.view_distance *= 1.5
    yield from gui.open_sidebar("Cubic Craft")
    button = yield from gui.find_button("cubic_craft.cubify")
    yield from gui.click(button)

    def status():
        return bpy.context.view_layer.objects.active.cubic_craft.status

    yield from gui.wait_until(
        lambda: status() and not gui.running_operators(), what="a cubic monkey"
    )
    gui.log("status:", status())
    assert device in status(), status()


def extensions():
    """Return Blender's folder of extensions."""
    return Path(bpy.utils.user_resource("EXTENSIONS"))


def unpacked_wheels():
    """Return the names of what Blender has unpacked from wheels."""
    version = f"python{sys.version_info[0]}.{sys.version_info[1]}"
    folder = extensions() / ".local" / "lib" / version / "site-packages"
    return {path.name for path in folder.iterdir()} if folder.exists() else set()
