# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames of a bake as they are solved, in a folder, so that a stopped one can continue.

Smoothing over time needs all frames, and the memory may be too small for them: they are appended
to a file and read back by pieces of the vertices. The folder is removed once the bake is complete.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import json
import shutil
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ... import solver
from ...solver.console.output import replacing
from ..environment.lock import Lock

_COLUMNS = 10  # input, turn as a quaternion, offset
_BYTES = 4 * _COLUMNS
_PIECE = 32_000_000  # bytes of float64 that are read at once
_FRAMES, _ABOUT, _STATE = "frames.f32", "about.json", "state.npz"


class Recording:
    """Frames of vertices in a folder.

    No other process has the folder until it is released.

    `folder`: it is made if it is not there. `about`: what the frames depend on, for JSON; frames of
    anything else are forgotten. `count`: of the frames. `state`: the end of the last frame, from
    which the next one is solved. `moment`: what the last frame depended on. Raises BusyError:
    another process has the folder.
    """

    def __init__(self, folder: Path, about: dict[str, Any], vertices: int):
        self.folder, self._vertices = folder, vertices
        self.count, self._checksum, self.moment = 0, 0, ""
        self.state: solver.SequenceState | None = None
        self._about = json.loads(json.dumps({**about, "vertices": vertices}))
        self.folder.parent.mkdir(parents=True, exist_ok=True)
        self._lock = Lock(self.folder)
        try:
            self._continue()
        except BaseException:
            self.release()
            raise

    def _continue(self):
        """Continue an earlier recording of the same, or begin."""
        saved = self._saved_in(self.folder)
        if saved is None:
            shutil.rmtree(self.folder, ignore_errors=True)
            self.folder.mkdir()
            (self.folder / _FRAMES).touch()
            (self.folder / _ABOUT).write_text(json.dumps(self._about), encoding="utf-8")
        else:
            self.count, self._checksum, self.moment, self.state = saved

    def _saved_in(self, folder) -> tuple[int, int, str, solver.SequenceState] | None:
        """Return the end of a recording of the same, if all its frames are there.

        That is their number, the checksum of all, the moment and the state.
        """
        try:
            if json.loads((folder / _ABOUT).read_text(encoding="utf-8")) != self._about:
                return None
            with np.load(folder / _STATE) as values:
                state = solver.SequenceState(
                    *(values[name] for name in solver.SequenceState._fields)
                )
                count, noted = int(values["count"]), int(values["checksum"])
                moment, checksum = str(values["moment"]), 0
            with (folder / _FRAMES).open("rb") as file:
                for _ in range(count):
                    checksum = zlib.crc32(file.read(self._frame_bytes), checksum)
        except (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile):
            return None
        return (count, checksum, moment, state) if checksum == noted else None

    @property
    def _frame_bytes(self):
        return self._vertices * _BYTES

    def append(self, frame: solver.Frames, state: solver.SequenceState | None, moment: str) -> None:
        """Add a frame, and what the next one continues from."""
        values = np.concatenate([part[0] for part in frame], axis=1, dtype=np.float32)
        self._write(np.ascontiguousarray(values).tobytes())
        self.state, self.moment = state, moment

    def _write(self, frame):
        with (self.folder / _FRAMES).open("r+b") as file:
            file.seek(self.count * self._frame_bytes)  # what lies there was never saved
            file.write(frame)
        self._checksum = zlib.crc32(frame, self._checksum)
        self.count += 1

    def save_state(self) -> None:
        """Make sure that the recording can continue after its last frame."""
        if self.state is None:
            return
        with replacing(self.folder / _STATE) as partial:
            known = {"count": self.count, "checksum": self._checksum, "moment": self.moment}
            np.savez(partial, **known, **self.state._asdict())

    def pieces(self, vertices: slice) -> Iterator[tuple[slice, solver.Frames]]:
        """Yield `Frames` of a part of the vertices by pieces, each with its place in that part."""
        path = self.folder / _FRAMES
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
            self.folder / _FRAMES,
            np.float32,
            count=self._vertices * _COLUMNS,
            offset=(self.count - 1) * self._frame_bytes,
        )
        values = values.reshape(1, self._vertices, _COLUMNS)
        return solver.Frames(values[..., :3], values[..., 3:7], values[..., 7:])

    def remove(self) -> None:
        """Remove the folder."""
        self.state = None
        shutil.rmtree(self.folder, ignore_errors=True)

    def release(self) -> None:
        """Let other processes have the folder; nothing can be done with this afterwards."""
        self._lock.release()
