# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of the last operator, at the lower left of the viewport."""

import guidrive as gui


def open_cubeness():
    """Open the panel by its header, if it is closed, and return its first row, the cubeness."""
    yield from gui.wait_until(lambda: gui.region("HUD").height > 1, what="the panel")
    yield from gui.wait_redraw()
    panel = gui.region("HUD")
    if panel.height <= 100:
        yield from gui.click((panel.x + panel.width // 2, panel.y + panel.height - 14))
        yield from gui.wait_until(lambda: gui.region("HUD").height > 100, what="the open panel")
    panel = gui.region("HUD")
    row = gui.Button("", panel.x + panel.width // 2, 0, panel.x + panel.width - 20, 0)
    top = panel.y + panel.height - 44
    return gui.Button("", row.left, top - 10, row.right, top + 10)
