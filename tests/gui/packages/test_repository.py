# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender that has nothing of ours is pointed at our repository: install, Cubify, update, remove.

/share/first and /share/newer are repositories; they are served on localhost, the only network.
"""

import fcntl
import os
import socket
import struct
import subprocess
import sys
import tomllib
import urllib.request

import bpy
import guidrive as gui
from preferences_area import WHERE, extensions, open_preferences, press, redraw, unpacked_wheels

PORT = 8642
URL = f"http://localhost:{PORT}/index.json"
MODULE = "studio"
INSTALL_SECONDS = 240.0  # a hundred megabytes are loaded, checked and unpacked


def loopback_up():
    """Switch on the loopback interface; the run has a network of its own without any."""
    set_flags, up_and_running = 0x8914, 0x41
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        fcntl.ioctl(any_socket, set_flags, struct.pack("16sh14x", b"lo", up_and_running))


class Server:
    """`python -m http.server` for a folder."""

    def __init__(self, folder):
        command = [sys.executable, "-m", "http.server", str(PORT), "--bind", "127.0.0.1"]
        self.process = subprocess.Popen(
            [*command, "--directory", folder], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )

    def wait(self):
        """Wait until it answers."""

        def answers():
            try:
                return urllib.request.urlopen(URL, timeout=1).status == 200
            except OSError:
                return False

        yield from gui.wait_until(answers, what="the server")

    def stop(self):
        self.process.terminate()
        self.process.wait()


def manifest():
    path = extensions() / MODULE / "cubic_craft" / "blender_manifest.toml"
    return tomllib.loads(path.read_text()) if path.exists() else {}


def addon():
    return f"bl_ext.{MODULE}.cubic_craft"


def add_repository():
    """Add ours, and remove Blender's own, which cannot be reached here."""
    repos = bpy.context.preferences.extensions.repos
    bpy.ops.preferences.extension_repo_add(
        name="Studio", remote_url=URL, use_sync_on_startup=False, type="REMOTE"
    )
    for index in reversed(range(len(repos))):
        if repos[index].remote_url not in ("", URL):
            bpy.ops.preferences.extension_repo_remove(index=index)
    (ours,) = [repo for repo in repos if repo.remote_url == URL]
    ours.module = MODULE


def synchronise():
    with gui.in_region(**WHERE):
        assert bpy.ops.extensions.repo_sync_all() == {"FINISHED"}
    yield from redraw()


def install(version):
    """Click on Install or Update, and wait until Blender has done it."""
    yield from press("extensions.package_install")
    yield from gui.wait_until(
        lambda: manifest().get("version") == version
        and addon() in bpy.context.preferences.addons
        and not gui.running_operators(),
        timeout=INSTALL_SECONDS,
        what=f"version {version}",
    )
    assert {"taichi", "scipy", "cholespy", "pyamg"} <= unpacked_wheels(), unpacked_wheels()
    assert "numpy" not in unpacked_wheels()
    yield from redraw()


def cubify():
    """Add a monkey and click on Cubify in the sidebar; Taichi must have done it."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
    yield from gui.open_sidebar("Cubic Craft")
    button = yield from gui.find_button("cubic_craft.cubify")
    yield from gui.click(button)
    yield from gui.wait_until(
        lambda: bpy.context.view_layer.objects.active.cubic_craft.status
        and not gui.running_operators(),
        timeout=120.0,
        what="a cubic monkey",
    )
    status = bpy.context.view_layer.objects.active.cubic_craft.status
    gui.log("status:", status)
    assert "taichi-cpu" in status, status
    file = sys.modules["taichi"].__file__
    assert file.startswith(str(extensions())), file


def remove():
    repos = list(bpy.context.preferences.extensions.repos)
    index = next(i for i, repo in enumerate(repos) if repo.module == MODULE)
    with gui.in_region(**WHERE):
        done = bpy.ops.extensions.package_uninstall(repo_index=index, pkg_id="cubic_craft")
    assert done == {"FINISHED"}
    assert not manifest() and addon() not in bpy.context.preferences.addons
    assert not {"taichi", "scipy"} & unpacked_wheels(), unpacked_wheels()
    assert not hasattr(bpy.types.Object, "cubic_craft")


def test():
    assert "taichi" not in sys.modules
    loopback_up()
    yield from open_preferences()
    yield from gui.screenshot("1_before.png")
    yield from press("extensions.userpref_allow_online")
    assert bpy.app.online_access
    server = Server("/share/first")
    yield from server.wait()
    add_repository()
    yield from synchronise()
    yield from gui.screenshot("2_offered.png")
    yield from install(os.environ["FIRST_VERSION"])
    yield from gui.screenshot("3_installed.png")
    yield from cubify()
    yield from gui.screenshot("4_cubified.png")
    server.stop()

    server = Server("/share/newer")
    yield from server.wait()
    yield from synchronise()
    yield from gui.screenshot("5_update_offered.png")
    yield from install(os.environ["NEWER_VERSION"])
    yield from cubify()
    yield from gui.screenshot("6_updated.png")
    server.stop()

    remove()
    yield from redraw()
    yield from gui.screenshot("7_removed.png")


gui.run(test)
