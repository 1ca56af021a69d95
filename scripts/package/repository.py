# SPDX-License-Identifier: GPL-3.0-or-later
"""A static extension repository: a folder that any web server can serve."""

import shutil

from build_extension import blender_tool


def make_repository(zips, output):
    """Copy the zips into a folder and have Blender's tool write the listing and a page.

    All addresses in the listing are relative, so that the folder can lie anywhere. The zip without
    wheels does not belong there: it is for all platforms, and Blender would then find two.
    """
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    for path in zips:
        shutil.copy(path, output / path.name)
    blender_tool("server-generate", "--repo-dir", output, "--html")
