# SPDX-License-Identifier: GPL-3.0-or-later
"""Load what decides in Live by itself: it must not need Blender, nor anything else of ours."""

import importlib.util
from pathlib import Path

_FOLDER = Path(__file__).resolve().parents[2] / "cubic_craft_addon" / "live"


def load(name):
    spec = importlib.util.spec_from_file_location(f"pure_{name}", _FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
