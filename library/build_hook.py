# SPDX-License-Identifier: GPL-3.0-or-later
"""Build hook of the wheel: `solver/` under the name `cubic_craft`, with its command line.

The extension and the wheel share the same files. A package named ``solver`` would be too general
for an environment with others, so their copies in the wheel say ``from cubic_craft import`` where
these, and the examples in their docstrings, say ``from solver import``. Nothing else is changed.
"""

import re
import shutil
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PACKAGE = "cubic_craft"
_ROOMS = (("solver", "**/*.py"), ("library", "__main__.py"), ("library", "command_line/**/*.py"))
_IMPORT = re.compile(r"^(\s*(?:>>> |\.\.\. )?from )solver\b", re.MULTILINE)


def renamed(text: str) -> str:
    """Return source code with its imports from the solver under the name of the package."""
    return _IMPORT.sub(rf"\g<1>{PACKAGE}", text)


def stage(root: Path, folder: Path) -> None:
    """Write the package into a folder, from the files of a checkout."""
    for room, files in _ROOMS:
        for source in sorted((root / room).glob(files)):
            target = folder / source.relative_to(root / room)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(renamed(source.read_text(encoding="utf-8")), encoding="utf-8")
    shutil.copy(root / "library" / "py.typed", folder)


class WheelHook(BuildHookInterface):
    """Stages the package in a temporary folder, which the wheel is made of."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Stage the files; hatchling calls it before it builds.

        Raises ValueError: an editable install, whose files could not have other imports than the
        sources.
        """
        if version == "editable":
            raise ValueError(
                "an editable install is not possible; import solver in the root of the checkout"
            )
        self._staged = Path(tempfile.mkdtemp(prefix="cubic_craft-"))
        stage(Path(self.root), self._staged)
        build_data["force_include"][str(self._staged)] = PACKAGE

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove the staged files."""
        shutil.rmtree(self._staged)
