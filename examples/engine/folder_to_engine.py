# SPDX-License-Identifier: GPL-3.0-or-later
"""Make each mesh of a folder cubic for a game engine, with three levels of detail and a picture.

    python examples/engine/folder_to_engine.py MESHES ASSETS [more options of the command line]

The extension is enabled in the Blender that is called, ``blender`` or what BLENDER names. It may be
started again: what is done is kept. At the end ``ASSETS/assets.json`` lists the files of each mesh.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

TRIANGLES = ("3000", "1000", "300")


def main(meshes, assets, *options):
    """Run the command, and return its exit code."""
    folder = Path(assets)
    report = folder.with_name(f"{folder.name}_report.json")
    command = [os.environ.get("BLENDER", "blender"), "--background", "--command", "cubic_craft"]
    command += [meshes, "--output-folder", assets, "--report", str(report)]
    command += ["--save-mesh", ".glb", "--low-poly", *TRIANGLES, *options]
    code = subprocess.run(command, check=False).returncode
    if code not in (0, 3):  # nothing was begun, or it was interrupted
        return code
    rows = json.loads(report.read_text(encoding="utf-8"))["files"]
    listed = {
        Path(row["input"]).name: [Path(path).name for path in row["outputs"]]
        for row in rows
        if "outputs" in row
    }
    (folder / "assets.json").write_text(json.dumps(listed, indent=2) + "\n", encoding="utf-8")
    for row in rows:
        name = Path(row["input"]).name
        print(name, row.get("error") or row["status"], sep=": ")
    return code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
