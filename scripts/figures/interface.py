# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 4: the interface, as the window tests have photographed it."""

import shutil
from pathlib import Path

__all__ = ("take",)

SCREENSHOT = "test_first_sculpture/first_3_live.png"
NAME = "figure_4_interface.png"


def take(screenshots: Path, output: Path) -> str:
    """Copy the last screenshot of the window tests, or keep the figure that is there.

    Parameters
    ----------
    screenshots : folder that the window tests write to, with a folder for each Blender
    output : folder of the figures

    Returns
    -------
    str
        What has been done.
    """
    target = output / NAME
    shots = list(screenshots.glob(f"*/{SCREENSHOT}"))
    if not shots:
        kept = f"{target} stays as it is" if target.exists() else "there is none"
        return f"figure 4: no window test has run here (make test-gui), {kept}"
    newest = max(shots, key=lambda path: path.stat().st_mtime)
    shutil.copyfile(newest, target)
    return f"figure 4: {target} is the screenshot {newest}"
