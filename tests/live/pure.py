# SPDX-License-Identifier: GPL-3.0-or-later
"""Load what decides in Live by itself: it must not need Blender, nor anything else of our code."""

import importlib.util
import sys
from pathlib import Path

_ADDON = Path(__file__).resolve().parents[2] / "cubic_craft_addon"


def load(name, package="live"):
    path = _ADDON / package / f"{name}.py"
    spec = importlib.util.spec_from_file_location(f"pure_{name}", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look there
    spec.loader.exec_module(module)
    return module
