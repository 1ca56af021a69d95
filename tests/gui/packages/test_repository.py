# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender without our code is pointed at our repository: install, Cubify, update, remove.

/share/first and /share/newer are repositories; they are served on localhost, the only network.
"""

import fcntl
import os
import socket
import struct
import subprocess
import sys
import urllib.request

import bpy
import guidrive as gui
from bl_pkg.bl_extension_notify import update_in_progress
from preferences_area import (
    WHERE,
    cubify,
    extensions,
    open_entry,
    open_preferences,
    press,
    redraw,
    remove,
    wait_installed,
)

PORT = 8642
URL = f"http://localhost:{PORT}/index.json"
MODULE = "studio"


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
    yield from gui.wait_until(lambda: not gui.running_operators(), what="the listing")
    yield from redraw()
    # Until Blender has checked for updates, the list is greyed out; then it moves up.
    yield from gui.wait_until(lambda: not update_in_progress(), what="the check for updates")
    yield from redraw()


def install(version, picture):
    """Click on Install or Update, and wait until Blender has done it."""
    button = yield from gui.find_button("extensions.package_install", **WHERE)
    yield from gui.screenshot(picture)
    yield from gui.click(button)
    yield from wait_installed(MODULE, version)


def use():
    """Cubify with the Taichi that has been installed."""
    yield from cubify("taichi-cpu")
    file = sys.modules["taichi"].__file__
    assert file.startswith(str(extensions())), file


def test():
    assert "taichi" not in sys.modules
    loopback_up()
    yield from open_preferences()
    yield from gui.screenshot("repository_1_before.png")
    yield from press("extensions.userpref_allow_online")
    assert bpy.app.online_access
    server = Server("/share/first")
    yield from server.wait()
    add_repository()
    yield from synchronise()
    yield from open_entry(MODULE)
    yield from install(os.environ["FIRST_VERSION"], "repository_2_offered.png")
    yield from gui.screenshot("repository_3_installed.png")
    yield from use()
    yield from gui.screenshot("repository_4_cubified.png")
    server.stop()

    server = Server("/share/newer")
    yield from server.wait()
    yield from synchronise()
    yield from install(os.environ["NEWER_VERSION"], "repository_5_update_offered.png")
    yield from use()
    yield from gui.screenshot("repository_6_updated.png")
    server.stop()

    yield from remove(MODULE)
    yield from gui.screenshot("repository_7_removed.png")


gui.run(test)
