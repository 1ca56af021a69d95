# SPDX-License-Identifier: GPL-3.0-or-later
"""Which files the frames of an object go to; no other object's are among them."""

import itertools
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import bpy

from ...solver import CubicCraftError
from ...solver.console.sources import folded
from ..environment.file_names import file_stems
from .playback import SUFFIXES
from .properties import SOURCE

_UNFINISHED = ".unfinished"  # suffix of the folders of recordings


@dataclass(frozen=True)
class BakeOptions:
    """Which frames, and where to."""

    start: int
    end: int
    folder: Path
    file_format: str = "CACHE"

    @property
    def frames(self):
        """The numbers of the frames."""
        return range(self.start, self.end + 1)


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


class Places:
    """The files of a bake, in its folder, which is made.

    Raises CubicCraftError: the folder cannot be used.
    """

    def __init__(self, options: BakeOptions):
        self._options = options
        self._stems = file_stems(bpy.data.objects)
        try:
            options.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CubicCraftError(
                f'the folder "{options.folder}" cannot be made: {error.strerror}'
            ) from error

    def recording_of(self, source: bpy.types.Object) -> Path:
        """Return the folder of what is solved."""
        return self._options.folder / f"{self._stems[source]}{_UNFINISHED}"

    def files_of(self, source: bpy.types.Object, recording: Path) -> tuple[Path, Path]:
        """Return the point cache to write, and the file that is to play, which may be the same.

        What plays is a file that no other object plays: one that was baked under this name and
        then renamed, or has the file as an input. A cache that is on its way to another format is
        in the folder of its recording, where it is in the way of no file.
        """
        file_format, stem = self._options.file_format, self._stems[source]
        played = {_place(path) for path in _played_by_others(source)}
        names = itertools.chain([stem], (f"{stem}.{number}" for number in itertools.count(2)))
        suffix = SUFFIXES[file_format]
        paths = (self._options.folder / f"{name}{suffix}" for name in names)
        path = next(path for path in paths if _place(path) not in played)
        is_cache = file_format == "CACHE"
        return path if is_cache else recording / f"{stem}{SUFFIXES['CACHE']}", path


def _played_by_others(source: bpy.types.Object) -> Iterator[str]:
    """Give the files that play in objects which were not baked from this one."""
    for obj in bpy.data.objects:
        if getattr(obj, SOURCE) == source:
            continue
        for user in (*obj.modifiers, *obj.constraints):
            if isinstance(user, bpy.types.MeshCacheModifier):
                yield bpy.path.abspath(user.filepath, library=obj.library)
            elif file := getattr(user, "cache_file", None):
                yield bpy.path.abspath(file.filepath, library=file.library)


def _place(path: Path | str) -> str:
    return folded(os.path.realpath(path))
