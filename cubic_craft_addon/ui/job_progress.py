# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress of Cubify in the panel."""

from collections.abc import Callable, Iterable

from ..job.watched import WatchedJob


def draw(layout, running: WatchedJob, fit: Callable[[Iterable[str]], str]) -> None:
    """Draw the bar, with the longest text that fits, and the button that ends it."""
    row = layout.row(align=True)
    row.progress(text=fit(running.step.texts), factor=running.step.factor)
    row.operator("cubic_craft.cubify_cancel", text="", icon="X")
