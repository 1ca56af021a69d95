# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies of packages that call themselves the next version: newer.py FOLDER ZIP... prints it."""

import re
import sys
import zipfile
from pathlib import Path

MANIFEST = "blender_manifest.toml"
_VERSION = re.compile(r'(?m)^version = "(\d+\.\d+\.)(\d+)"$')


def newer(path, folder):
    """Write the copy; return both versions."""
    with zipfile.ZipFile(path) as source:
        text = source.read(MANIFEST).decode()
        old = _VERSION.search(text)
        version = f"{old[1]}{int(old[2]) + 1}"
        target = folder / path.name.replace(old[1] + old[2], version)
        with zipfile.ZipFile(target, "w") as copy:
            for item in source.infolist():
                content = source.read(item)
                if item.filename == MANIFEST:
                    content = _VERSION.sub(f'version = "{version}"', text).encode()
                copy.writestr(item, content)
    return old[1] + old[2], version


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    versions = {newer(Path(name), folder) for name in sys.argv[2:]}
    print(*versions.pop())
