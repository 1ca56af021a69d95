# SPDX-License-Identifier: GPL-3.0-or-later
"""The version of the extension."""

import tomllib
from pathlib import Path

_MANIFEST = Path(__file__).resolve().parents[3] / "blender_manifest.toml"


def version() -> str:
    """Return the version, as the manifest has it."""
    return tomllib.loads(_MANIFEST.read_text(encoding="utf-8"))["version"]
