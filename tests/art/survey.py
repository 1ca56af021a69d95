# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw meshes as artists have them: as they are, as in the paper, and as Cubify makes them.

survey.py FOLDER [CASE or FILE ...] [--cubeness C] [--set NAME=VALUE ...]

Without names all cases are done. A case is a name of `art_cases.CASES`; a file .obj, .ply or .glb.
All pictures are on sheet.png, too. What is measured of the cases is in the tests.
"""

import argparse
import contextlib
import io
import sys
from argparse import Namespace
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "scripts")]

import bpy  # noqa: E402
import numpy as np  # noqa: E402
from art_cases import CASES, PAPER, Case, cubified  # noqa: E402
from art_objects import material  # noqa: E402
from mathutils import Matrix  # noqa: E402

from cubic_craft import registered  # noqa: E402
from cubic_craft.cubic_craft_addon.command_line.picture import gallery, render, studio  # noqa: E402

IMPORTERS = {".obj": "obj_import", ".ply": "ply_import"}
RESOLUTION = (900, 330)
SAMPLES = 24
FINISHES = ("clay", "grey", "teal")
COLUMNS = 2
"""of the sheet"""


def main():
    """Draw each case, and the sheet of all."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("folder", type=Path, help="of the pictures")
    parser.add_argument("cases", nargs="*", metavar="CASE", help=", ".join(CASES))
    parser.add_argument("--cubeness", type=float, default=0.4)
    parser.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE", help="of Cubify")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    given, written = dict(map(_setting, options.set)), []
    with registered():
        for name in options.cases or CASES:
            case = CASES.get(name) or Case(partial(_load, Path(name)))
            asked = {"cubeness": options.cubeness, **case.options, **given}
            _, paper = _cubified(case, asked | PAPER)
            objects, now = _cubified(case, asked)
            path = options.folder / f"{Path(name).stem}.png"
            shapes = {"as it is": paper.rest, "as in the paper": paper.after, "now": now.after}
            _draw(objects, shapes, path)
            print(path, flush=True)
            written.append(path)
    _write_sheet(written, options.folder / "sheet.png")


def _cubified(case, asked):
    """Return the objects of a case in a file of their own, and what came out."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with contextlib.redirect_stdout(io.StringIO()):
        objects = case.make()
        return objects, cubified(objects, **asked)


def _setting(text):
    name, value = text.split("=")
    with contextlib.suppress(ValueError):
        return name, float(value)
    return name, value


def _load(path):
    """Return the mesh objects of a file, with vertices as they are there."""
    if path.suffix in IMPORTERS:
        getattr(bpy.ops.wm, IMPORTERS[path.suffix])(filepath=str(path))
    else:
        bpy.ops.import_scene.gltf(filepath=str(path), merge_vertices=False)
    return [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]


def _draw(objects, surfaces, path):
    """Write a picture of surfaces of the objects, which are the values of their labels."""
    scene = gallery.scene_for_gallery()
    size = gallery.extent_of(next(iter(surfaces.values())).V)
    places = [Matrix()] * len(objects)
    groups = [
        gallery.Group(label, _copies(objects, surface, scene), places, surface.V, size, finish)
        for (label, surface), finish in zip(surfaces.items(), FINISHES, strict=True)
    ]
    bpy.context.view_layer.update()
    arranged = gallery.arrange(groups, scene, RESOLUTION)
    studio.furnish(arranged, RESOLUTION[0] / RESOLUTION[1])
    how = {"engine": "cycles", "resolution": RESOLUTION, "samples": SAMPLES, "turntable": 0}
    list(render.render(arranged, [path], Namespace(**how)))


def _copies(objects, surface, scene):
    """Return copies with the surface's positions in world space."""
    copies = []
    for number, obj in enumerate(objects):
        mesh = obj.data.copy()
        if len(objects) > 1 and not mesh.materials:
            mesh.materials.append(material(number))
        V = surface.V[surface.owner == number].astype(np.float32)
        mesh.vertices.foreach_set("co", V.ravel())
        mesh.update()
        copy = bpy.data.objects.new(obj.name, mesh)
        scene.collection.objects.link(copy)
        copies.append(copy)
    return copies


def _write_sheet(paths, path):
    """Write pictures of one size as one, row by row."""
    width, height = RESOLUTION
    rows = -(-len(paths) // COLUMNS)
    sheet = np.ones((rows, height, COLUMNS, width, 4), np.float32)  # the lowest row first
    for number, single in enumerate(paths):
        image = bpy.data.images.load(str(single))
        pixels = np.empty(4 * width * height, np.float32)
        image.pixels.foreach_get(pixels)
        row, column = divmod(number, COLUMNS)
        sheet[rows - 1 - row, :, column] = pixels.reshape(height, width, 4)
        bpy.data.images.remove(image)
    image = bpy.data.images.new("Sheet", COLUMNS * width, rows * height)
    image.pixels.foreach_set(sheet.ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()


if __name__ == "__main__":
    main()
