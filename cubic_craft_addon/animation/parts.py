# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the frames that are solved apart from each other, on several machines.

A frame is solved from the end of the one before, of which it forgets a share, see `FrameSequence`.
So a part begins some frames early, without keeping these: what it does not know of the frames
before them is forgotten by then. Where nothing moves, nothing is solved and so nothing forgotten.
"""

from collections.abc import Sequence

LEAD_IN = 8
"""Frames in which something moves; what is left of the first, 0.15 to this power, is 3e-7."""


def part_of(count: int, number: int, parts: int) -> range:
    """Return the indices of the frames of a part, of so many frames in all.

    `count`: of frames. `number`: of the part, from 1. `parts`: how many there are; they differ by
    at most one frame.
    """
    return range((number - 1) * count // parts, number * count // parts)


def lead_in(moments: Sequence[str]) -> int:
    """Return the index of the first frame before a part that is solved for it.

    `moments`: what each of the frames before the part depends on.
    """
    changes = [i for i in range(1, len(moments)) if moments[i] != moments[i - 1]]
    return changes[-LEAD_IN] if len(changes) >= LEAD_IN else 0
