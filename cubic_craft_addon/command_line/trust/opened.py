# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file may bring into Blender: nothing that writes files, or reads any outside its folder.

What decides about the shape is refused, so that no other shape comes out. What decides about looks
alone is left out: its path is emptied, and that of an image comes back where a .blend is saved.
"""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

from ....solver.console.errors import InputError
from .places import is_inside

_LOOKS = (
    *(bpy.types.Image, bpy.types.MovieClip, bpy.types.Sound, bpy.types.Text),
    *(bpy.types.VectorFont, bpy.types.Node),
)
_BUILT_IN = "<builtin>"
"""path of Blender's own font"""
_IMPORTS = "GeometryNodeImport"
"""first letters of the nodes that read files, whose paths may be computed"""
_ON_DISK = ("use_disk_cache", "use_external")
_emptied: dict[str, str] = {}
"""paths of the images of the file that is open, by their full names"""


@contextlib.contextmanager
def checked_before_evaluation(path: Path) -> Iterator[list[str]]:
    """Check a .blend that is opened in the block, before Blender evaluates anything of it.

    What is left out is in the list that it gives, as `check_opened` returns it.

    Raises InputError: something in it is refused; nothing of it is left in Blender.
    """
    errors: list[Exception] = []
    left_out: list[str] = []

    @bpy.app.handlers.persistent
    def check(*_: object) -> None:
        try:
            left_out.extend(check_opened(path))
        except Exception as error:  # Blender would print it and go on
            errors.append(error)
            bpy.data.batch_remove(list(bpy.data.objects))

    bpy.app.handlers.load_post.append(check)
    try:
        yield left_out
    finally:
        bpy.app.handlers.load_post.remove(check)
    if errors:
        raise errors[0]


def check_opened(path: Path) -> list[str]:
    """Check what Blender has read of a file: refuse, or leave out, what leads out of its folder.

    Returns the paths that are left out and that there is something at. Raises InputError: naming
    what is refused, and the cure.
    """
    _emptied.clear()
    bpy.data.use_autopack = False  # which puts the bytes of all files that it names into a .blend
    home, left_out = path.resolve().parent, []
    for problem in _simulations(home):
        raise InputError(f"{path}: {problem}")
    for owner, holder in _holders():
        text = holder.filepath
        if text in ("", _BUILT_IN) or _is_allowed(owner, text, home):
            continue
        if not isinstance(holder, _LOOKS):
            raise InputError(
                f'{path}: "{holder.name}" refers to {text}, which is not a file in its folder; '
                "move that there, or make it part of the file"
            )
        if isinstance(holder, bpy.types.Image):
            _emptied[holder.name_full] = text
        holder.filepath = ""
        left_out += [text] if os.path.lexists(_absolute(owner, text)) else []
    return left_out


def _holders() -> Iterator[tuple[Any, Any]]:
    """Give all data-blocks with what of them has the path of a file: itself, a node, a modifier."""
    for owner in list(bpy.data.user_map()):
        tree = owner if isinstance(owner, bpy.types.NodeTree) else getattr(owner, "node_tree", None)
        nodes = tree.nodes if tree is not None else ()
        for holder in (owner, *nodes, *getattr(owner, "modifiers", ())):
            if hasattr(holder, "filepath"):
                yield owner, holder


@contextlib.contextmanager
def with_all_paths() -> Iterator[None]:
    """Give the images in the block, in which none is read, the paths that they have in the file."""
    images = [image for image in bpy.data.images if image.name_full in _emptied]
    try:
        for image in images:
            image.filepath = _emptied[image.name_full]
        yield
    finally:
        for image in images:
            image.filepath = ""


def _simulations(home: Path) -> Iterator[str]:
    """Say what would write files, or read some that are not said to be read."""
    for obj in bpy.data.objects:
        for modifier in obj.modifiers:
            settings = getattr(modifier, "domain_settings", None)
            if settings is not None:
                yield f'the fluid of "{obj.name}" is kept in files; apply or remove its modifier'
        for place in (*obj.modifiers, *obj.particle_systems):
            canvas = getattr(place, "canvas_settings", None)
            surfaces = canvas.canvas_surfaces if canvas is not None else ()
            caches = [getattr(each, "point_cache", None) for each in (place, *surfaces)]
            if any(getattr(cache, name) for cache in caches if cache for name in _ON_DISK):
                yield (
                    f'the simulation "{place.name}" of "{obj.name}" is kept in files; turn off '
                    "Disk Cache and External in its cache"
                )
            own = [getattr(place, "bake_directory", "")]
            own += [bake.directory for bake in getattr(place, "bakes", ())]
            if not all(is_inside(_absolute(obj, folder), home) for folder in own if folder):
                yield (
                    f'the simulation "{place.name}" of "{obj.name}" is baked to another place; '
                    "pack it, or clear its folder"
                )
    for scene in bpy.data.scenes:
        world = scene.rigidbody_world
        if world and any(getattr(world.point_cache, name) for name in _ON_DISK):
            yield f'the rigid bodies of "{scene.name}" are kept in files; turn off Disk Cache'
    for group in bpy.data.node_groups:
        for node in group.nodes:
            if node.bl_idname.startswith(_IMPORTS):
                yield f'the nodes "{group.name}" read a file ("{node.name}"); apply their modifier'
    for curve in _animated():
        if curve.data_path.rpartition(".")[2] in _ON_DISK:
            yield f"{curve.data_path} is animated; remove that"


def _animated() -> Iterator[Any]:
    """Give all drivers, and the curves of all actions."""
    for owner in bpy.data.user_map():
        animation = getattr(owner, "animation_data", None)
        yield from animation.drivers if animation else ()
    for action in bpy.data.actions:
        yield from getattr(action, "fcurves", ())
        for layer in getattr(action, "layers", ()):
            for bag in (bag for strip in layer.strips for bag in strip.channelbags):
                yield from bag.fcurves


def _is_allowed(owner: Any, path: str, home: Path) -> bool:
    """Return whether the path of a data-block leads into the folder, or is not looked up."""
    is_packed = getattr(owner, "packed_file", None) or getattr(owner, "packed_files", None)
    place = _absolute(owner, path)
    if is_packed or is_inside(place, home):
        return True
    is_library = isinstance(owner, bpy.types.Library)
    return is_library and (is_inside(place, _own_data()) or not Path(place).exists())


def _absolute(owner: Any, path: str) -> str:
    """Return where Blender looks for the path of a data-block."""
    library = None if isinstance(owner, bpy.types.Library) else owner.library
    return os.path.abspath(bpy.path.abspath(path, library=library))  # noqa: PTH100  # no links


def _own_data() -> Path:
    """Return where Blender's own files are, such as the nodes behind Shade Auto Smooth."""
    return Path(bpy.utils.resource_path("LOCAL")).resolve()
