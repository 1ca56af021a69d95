# SPDX-License-Identifier: GPL-3.0-or-later
"""The checksums of what is handed on, as the command ``sha256sum --check`` reads them."""

import hashlib
from pathlib import Path

NAME = "SHA256SUMS"


def write_checksums(folder: Path) -> Path:
    """Write the file of checksums of all other files in a folder, and return its path."""
    files = sorted(path for path in folder.iterdir() if path.is_file() and path.name != NAME)
    target = folder / NAME
    target.write_text("".join(f"{_checksum(path)}  {path.name}\n" for path in files))
    return target


def _checksum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
