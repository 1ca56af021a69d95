# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames of a bake as they are solved, in a folder, so that a stopped one can continue.

Smoothing over time needs all frames, and the memory may be too small for them: they are appended
to a file and read back by pieces of the vertices. The folder is removed once the bake is complete.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import glob
import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ... import solver
from ..environment.new_file import replacing

_COLUMNS = 10  # input, turn as a quaternion, offset
_BYTES = 4 * _COLUMNS
_PIECE = 32_000_000  # bytes of float64 that are read at once
_PART = ".part_"  # behind the name of the folder, and before the indices
_FRAMES, _ABOUT, _STATE = "frames.f32", "about.json", "state.npz"


class Recording:
    """Frames of vertices in a folder.

    Parameters
    ----------
    folder : Path
        It is made if it is not there.
    about : dict
        What the frames depend on, for JSON; frames of anything else are forgotten.
    vertices : int
    part : range, optional
        Indices of the frames that are solved here, apart from the others. Without it, what parts
        have solved is taken over.

    Attributes
    ----------
    count : int
        Number of frames.
    state : SequenceState or None
        The end of the last frame, from which the next one is solved.
    moment : str
        What the last frame depended on.
    """

    def __init__(
        self, folder: Path, about: dict[str, Any], vertices: int, part: range | None = None
    ):
        place = "" if part is None else f"{_PART}{part.start:07}_{part.stop:07}"
        self._folder, self._vertices = folder.with_name(folder.name + place), vertices
        self.count = 0
        self.state: solver.SequenceState | None = None
        self.moment = ""
        about = json.loads(json.dumps({**about, "vertices": vertices}))
        if not self._continue(about):
            self.remove()
            self._folder.mkdir(parents=True)
            (self._folder / _FRAMES).touch()
            (self._folder / _ABOUT).write_text(json.dumps(about), encoding="utf-8")
        if part is None:
            self._take_parts(about)

    def _continue(self, about):
        """Continue an earlier recording of the same; return whether there is one."""
        try:
            known = json.loads((self._folder / _ABOUT).read_text(encoding="utf-8"))
            with np.load(self._folder / _STATE) as saved:
                count, moment = int(saved["count"]), str(saved["moment"])
                state = _state(saved)
            size = (self._folder / _FRAMES).stat().st_size
        except (OSError, ValueError, KeyError):
            return False
        if known != about or size < count * self._frame_bytes:
            return False
        self.count, self.state, self.moment = count, state, moment
        with (self._folder / _FRAMES).open("r+b") as file:
            file.truncate(count * self._frame_bytes)
        return True

    def _take_parts(self, about):
        """Append what was solved apart, as far as each part follows on."""
        for folder in sorted(self._folder.parent.glob(f"{glob.escape(self._folder.name)}{_PART}*")):
            begin, end = map(int, folder.name.rpartition(_PART)[2].split("_"))
            part = Recording(self._folder, about, self._vertices, range(begin, end))
            if begin <= self.count < begin + part.count:
                with (
                    (folder / _FRAMES).open("rb") as its,
                    (self._folder / _FRAMES).open("ab") as file,
                ):
                    its.seek((self.count - begin) * self._frame_bytes)
                    shutil.copyfileobj(its, file)
                self.count, self.state, self.moment = begin + part.count, part.state, part.moment
                self.save_state()

    @property
    def _frame_bytes(self):
        return self._vertices * _BYTES

    def append(self, frame: solver.Frames, state: solver.SequenceState | None, moment: str) -> None:
        """Add a frame, and what the next one continues from."""
        values = np.concatenate([part[0] for part in frame], axis=1, dtype=np.float32)
        with (self._folder / _FRAMES).open("ab") as file:
            file.write(np.ascontiguousarray(values).data)
        self.count += 1
        self.state, self.moment = state, moment

    def save_state(self) -> None:
        """Make sure that the recording can continue after its last frame."""
        if self.state is None:
            return
        with replacing(self._folder / _STATE) as partial:
            np.savez(partial, count=self.count, moment=self.moment, **self.state._asdict())

    def pieces(self, vertices: slice) -> Iterator[tuple[slice, solver.Frames]]:
        """Yield `Frames` of a part of the vertices by pieces, each with its place in that part."""
        path = self._folder / _FRAMES
        shape = (self.count, self._vertices, _COLUMNS)
        step = max(1, _PIECE // (8 * _COLUMNS * max(self.count, 1)))
        for begin in range(vertices.start, vertices.stop, step):
            end = min(begin + step, vertices.stop)
            frames = np.memmap(path, np.float32, "r", shape=shape)
            values = frames[:, begin:end].astype(np.float64)
            del frames  # what was mapped counts as memory that is used
            piece = solver.Frames(values[..., :3], values[..., 3:7], values[..., 7:])
            yield slice(begin - vertices.start, end - vertices.start), piece

    def last(self) -> solver.Frames:
        """Return the last frame."""
        values = np.fromfile(
            self._folder / _FRAMES, np.float32, offset=(self.count - 1) * self._frame_bytes
        )
        values = values.reshape(1, self._vertices, _COLUMNS)
        return solver.Frames(values[..., :3], values[..., 3:7], values[..., 7:])

    def remove(self) -> None:
        """Remove the folder."""
        self.state = None
        shutil.rmtree(self._folder, ignore_errors=True)


def _state(saved):
    state = solver.SequenceState
    return state(*(saved[name] for name in state._fields))
