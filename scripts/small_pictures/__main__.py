# SPDX-License-Identifier: GPL-3.0-or-later
"""Render the pictures of presets or forms in the panel."""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

import bpy  # noqa: E402, F401  # it has bmesh, which others import

from cubic_craft import registered  # noqa: E402
from small_pictures import bear, forms  # noqa: E402

KINDS = {
    # what renders all, or only those that are named; samples
    "presets": (bear.render_presets, 64),
    "forms": (forms.render_forms, 256),
}


def main() -> None:
    """Render what is asked for."""
    parser = argparse.ArgumentParser(prog="small_pictures", description=__doc__)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="presets or forms (default: all)")
    parser.add_argument("--samples", type=int, metavar="N")
    options = parser.parse_args()
    render, samples = KINDS[options.kind]
    with registered():
        render(options.only, options.samples or samples)


if __name__ == "__main__":
    main()
