# SPDX-License-Identifier: GPL-3.0-or-later
"""Which frames to bake, where to, and how that went."""

from dataclasses import dataclass
from pathlib import Path

from ..settings.overrides import SettingsOverrides


@dataclass(frozen=True)
class BakeOptions:
    """Which frames, and where to."""

    start: int
    end: int
    folder: Path
    file_format: str = "CACHE"
    is_process: bool = False
    """whether the frames show how the present shape becomes cubic, at even speed"""
    process_from: SettingsOverrides | None = None
    """the settings that it begins with; None is the original"""
    is_patient: bool = False
    """whether to wait while another bake has the same files, and not to refuse"""
    part: range | None = None
    """indices of the frames to solve, apart from the others; None is all, and writes them"""

    @property
    def frames(self):
        """The numbers of the frames."""
        return range(self.start, self.end + 1)

    @property
    def indices(self):
        """The indices of those to solve."""
        return range(len(self.frames)) if self.part is None else self.part


@dataclass(frozen=True)
class BakeResult:
    """How an object was baked."""

    name: str
    frames: int
    smoothed: float
    """over how many frames, as a standard deviation"""
    largest_jump: float
    """relative to that of the input"""
    common_jump: float
    """the 99th percentile, relative to that of the input"""
