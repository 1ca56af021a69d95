# SPDX-License-Identifier: GPL-3.0-or-later
"""A furnished gallery and the format of its picture."""

from dataclasses import dataclass

from headless.gallery import Gallery, Group, arrange, scene_for_gallery
from headless.studio import furnish

__all__ = ("Picture", "side_by_side")

NOMINAL_WIDTH = 1600


@dataclass(frozen=True)
class Picture:
    """What is rendered."""

    gallery: Gallery
    height: int
    """pixels, of a picture `NOMINAL_WIDTH` pixels wide"""

    def resolution(self, width: int) -> tuple[int, int]:
        """Return width and height in pixels for a width."""
        return width, round(width * self.height / NOMINAL_WIDTH)


def side_by_side(groups: list[Group], height: int) -> Picture:
    """Arrange groups, whose copies are in no scene yet, as large as the format allows."""
    scene = scene_for_gallery()
    for group in groups:
        for copy in group.copies:
            scene.collection.objects.link(copy)
    gallery = arrange(groups, scene, (NOMINAL_WIDTH, height))
    furnish(gallery, NOMINAL_WIDTH / height)
    return Picture(gallery, height)
