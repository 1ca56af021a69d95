# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user does with a package in a Blender that has nothing else: session.py WHAT ZIP.

``first``: install, Cubify a small and a large mesh, disable, enable, remove, install again, Cubify;
``later``: in another Blender with the same user folder, Cubify.
Run with BLENDER_USER_RESOURCES set. Opening a socket is an error.
"""

import os
import socket
import sys
from pathlib import Path


def refuse(*_, **__):
    raise AssertionError("went online")


for name in ("create_connection", "getaddrinfo"):
    setattr(socket, name, refuse)

import bpy  # noqa: E402

NAME = "bl_ext.user_default.cubic_craft"
BROUGHT = ("taichi", "scipy", "cholespy", "pyamg", "rich")
FOLDER = Path(os.environ["BLENDER_USER_RESOURCES"])


def check(done):
    assert done == {"FINISHED"}, done


def site_packages():
    """Return the folder into which Blender unpacks wheels, as it is now."""
    version = f"python{sys.version_info[0]}.{sys.version_info[1]}"
    folder = FOLDER / "extensions" / ".local" / "lib" / version / "site-packages"
    return {path.name for path in folder.iterdir()} if folder.exists() else set()


def install(archive):
    check(
        bpy.ops.extensions.package_install_files(
            filepath=archive, repo="user_default", enable_on_install=True
        )
    )
    assert set(BROUGHT) <= site_packages(), site_packages()
    assert "numpy" not in site_packages()


def cubify(**settings):
    check(bpy.ops.cubic_craft.cubify(**settings))
    status = bpy.context.object.cubic_craft.status
    print("status:", status)
    assert "taichi-cpu" in status, status


def cubify_monkey():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.mesh.primitive_monkey_add()
    cubify()


def cubify_large():
    """More than 60,000 vertices, from which on pyamg is used."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=320, ring_count=200)
    cubify(max_iterations=3)


def check_imports(*names):
    """Check that these have been imported from the package; NumPy is Blender's."""
    for name in names:
        file = sys.modules[name].__file__
        assert Path(file).is_relative_to(FOLDER), file
    assert not Path(sys.modules["numpy"].__file__).is_relative_to(FOLDER)


def remove():
    check(bpy.ops.extensions.package_uninstall(repo_index=repository(), pkg_id="cubic_craft"))
    assert NAME not in bpy.context.preferences.addons
    assert not hasattr(bpy.types.Object, "cubic_craft")
    assert not set(BROUGHT) & site_packages(), site_packages()


def repository():
    """Return the index of the repository that a zip is installed into."""
    repos = bpy.context.preferences.extensions.repos
    return next(i for i, repo in enumerate(repos) if repo.module == "user_default")


def first(archive):
    assert not site_packages()
    install(archive)
    cubify_monkey()
    cubify_large()
    check_imports("taichi", "scipy", "cholespy", "pyamg")
    check(bpy.ops.preferences.addon_disable(module=NAME))
    assert not hasattr(bpy.types.Object, "cubic_craft")
    check(bpy.ops.preferences.addon_enable(module=NAME))
    cubify_monkey()
    remove()
    install(archive)
    cubify_monkey()


def later(_archive):
    # Blender as a module does not read its preferences, and 4.2 crashes when told to.
    check(bpy.ops.preferences.addon_enable(module=NAME))
    cubify_monkey()
    check_imports("taichi", "scipy", "cholespy")
    remove()


if __name__ == "__main__":
    {"first": first, "later": later}[sys.argv[1]](sys.argv[2])
    print("done in", bpy.app.version_string, flush=True)
    os._exit(0)  # Blender 4.2 crashes while it is freed
