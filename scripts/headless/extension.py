# SPDX-License-Identifier: GPL-3.0-or-later
"""Load the extension from its source tree, under the name that Blender gives it."""

import contextlib
import importlib
import importlib.util
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

from .errors import InputError

__all__ = ("Extension", "read_version", "registered")

PACKAGE = "cubic_craft"


class Extension:
    """The rooms of the loaded extension that the scripts use."""

    def __init__(self, root: Path) -> None:
        self.bake = _room("cubic_craft_addon.animation.bake")
        self.exchange = _room("cubic_craft_addon.animation.exchange")
        self.parts = _room("cubic_craft_addon.animation.parts")
        self.pipeline = _room("cubic_craft_addon.run.pipeline")
        self.form = _room("cubic_craft_addon.read.form")
        self.form_pictures = _room("cubic_craft_addon.settings.form_pictures")
        self.forms = _room("cubic_craft_addon.settings.forms")
        self.handles = _room("cubic_craft_addon.handles")
        self.member = _room("cubic_craft_addon.read.member")
        self.mesh_bridge = _room("cubic_craft_addon.mesh_bridge")
        self.named_forms = _room("solver.styles.forms")
        self.presets = _room("cubic_craft_addon.presets.files")
        self.region = _room("cubic_craft_addon.settings.region")
        self.settings = _room("cubic_craft_addon.settings.values")
        self.solver = _room("solver")
        self._warnings = _room("cubic_craft_addon.environment.engine_notes")
        self.version = read_version(root)

    def notices(self) -> list[str]:
        """Return what there is to say about this machine after a run, one line each."""
        return self._warnings.new_engine_warnings()


@contextlib.contextmanager
def registered(root: Path) -> Iterator[Extension]:
    """Import the repository root as the package ``cubic_craft``, and register it for the block.

    The root may have any folder name; inside, all imports are relative to the package.
    """
    spec = importlib.util.spec_from_file_location(
        PACKAGE, root / "__init__.py", submodule_search_locations=[str(root)]
    )
    if spec is None or spec.loader is None:
        raise InputError(f"{root}: there is no CubicCraft extension here; run the script in place")
    package = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = package
    spec.loader.exec_module(package)
    package.register()
    try:
        yield Extension(root)
    finally:
        package.unregister()


def read_version(root: Path) -> str:
    """Return the version of the extension, as its manifest has it."""
    manifest = tomllib.loads((root / "blender_manifest.toml").read_text(encoding="utf-8"))
    return manifest["version"]


def _room(name: str) -> ModuleType:
    return importlib.import_module(f"{PACKAGE}.{name}")
