# SPDX-License-Identifier: GPL-3.0-or-later
"""Put meshes as artists have them through Cubify and print what became of them.

survey.py [CASE or FILE ...] [--cubeness C ...] [--paper] [--pictures FOLDER]

Without names all cases are done. A case is a name of `art_cases.CASES`; a file .obj, .ply or .glb.
"""

import argparse
import contextlib
import io
import sys
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "scripts")]

import bpy  # noqa: E402
import measures  # noqa: E402
import survey_pictures  # noqa: E402
from art_cases import CASES, PAPER, Case, cubified  # noqa: E402
from art_objects import unpainted  # noqa: E402

from cubic_craft import registered  # noqa: E402

COLUMNS = (
    # heading, width
    ("case", -16),
    ("lam", 5),
    ("vertices", 9),
    ("parts", 6),
    ("angle", 14),
    ("ratio", 6),
    ("drift %", 8),
    ("seat %", 7),
    ("tear %", 7),
    ("turn", 10),
    ("shift %", 8),
    ("still %", 8),
    ("volume", 7),
    ("inside %", 12),
    ("crossings", 12),
    ("seconds", 8),
)
IMPORTERS = {".obj": "obj_import", ".ply": "ply_import"}


def main():
    """Print a row for each case and cubeness."""
    options = _arguments()
    with registered():
        print(_line([heading for heading, _ in COLUMNS]))
        for name in options.cases or CASES:
            for cubeness in options.cubeness:
                _survey(name, cubeness, options)
    if options.pictures:
        survey_pictures.write_sheet(options.written, options.pictures / "sheet.png")


def _arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("cases", nargs="*", metavar="CASE", help=", ".join(CASES))
    parser.add_argument("--cubeness", type=float, nargs="+", default=[0.4])
    parser.add_argument("--paper", action="store_true", help="the settings of the paper")
    parser.add_argument(
        "--set", nargs="+", default=[], metavar="NAME=VALUE", help="of the operator"
    )
    parser.add_argument(
        "--pictures", type=Path, metavar="FOLDER", help="as PNG, and all on a sheet"
    )
    options = parser.parse_args()
    options.written = []
    for name in options.cases:
        if name not in CASES and not Path(name).is_file():
            parser.error(f"{name}: neither a case nor a file")
    return options


def _survey(name, cubeness, options):
    case = CASES.get(name) or Case(partial(_load, Path(name)))
    asked = {"cubeness": cubeness, **case.options, **(PAPER if options.paper else {})}
    asked |= dict(map(_setting, options.set))
    if options.pictures:
        *_, paper = _cubified(case, asked | PAPER)
    objects, is_still, outcome = _cubified(case, asked)
    short = name if name in CASES else Path(name).stem
    print(_line(_row(short, cubeness, case, outcome, is_still)), flush=True)
    if options.pictures:
        path = options.pictures / f"{short}_{cubeness:g}.png"
        shapes = {"as it is": paper.rest, "as in the paper": paper.after, "now": outcome.after}
        survey_pictures.render(objects, shapes, path)
        options.written.append(path)


def _cubified(case, asked):
    """Return the objects of a case in a file of their own, what stays, and what came out."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with contextlib.redirect_stdout(io.StringIO()):
        objects = case.make()
        is_still = unpainted(objects, case.options.get("map_group"))
        return objects, is_still, cubified(objects, **asked)


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


def _row(name, cubeness, case, outcome, is_still):
    V, U, F = outcome.V, outcome.U, outcome.F
    rest, after = outcome.angle()
    inside = "-"
    if case.is_dressed:
        inside = " -> ".join(f"{100 * share:.1f}" for share in outcome.inside())
    return [
        name,
        f"{cubeness:g}",
        f"{len(V)}",
        f"{measures.part_of(V, F)[0]}",
        f"{rest:.1f} -> {after:.1f}",
        f"{after / rest:.2f}" if rest > 1e-3 else "-",
        f"{100 * outcome.drift():.2f}",
        f"{100 * outcome.seat():.2f}",
        f"{100 * measures.tear(V, U):.2f}",
        f"{measures.turn(V, U):.1f} ({measures.turn(V, U, F):.1f})",
        f"{100 * measures.shift(V, U, F):.2f}",
        f"{100 * measures.movement(V, U, is_still):.2f}" if is_still.any() else "-",
        f"{outcome.volume_ratio():.2f}" if measures.is_closed(V, F) else "-",
        inside,
        "{} -> {}".format(*outcome.crossings()),
        f"{outcome.seconds:.1f}",
    ]


def _line(cells):
    widths = [width for _, width in COLUMNS]
    return "  ".join(
        cell.ljust(-width) if width < 0 else cell.rjust(width)
        for cell, width in zip(cells, widths, strict=True)
    )


if __name__ == "__main__":
    main()
