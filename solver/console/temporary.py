# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are never left half-written: under a temporary name until they are whole."""

import contextlib
import os
import platform
import re
import shutil
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

from .output import errors_of, move_into_place

_LONGEST_STEM = 100  # bytes of it in the name of a temporary file, which must not be too long
_begins: list[Path] = []  # of the temporary files of this process, without suffix
_removing = threading.Lock()


@contextlib.contextmanager
def replacing(path: Path, has_own_name: bool = False) -> Iterator[Path]:
    """Give a temporary path beside ``path`` and move it there if the block succeeds.

    The temporary file has the same suffix and folder, so that exporters see the right format and
    relative paths stay right, and it is removed however the block ends. What runs that were killed
    have left of the same file is removed as well, and what lies where it shall be written, which
    might be a link.

    `has_own_name`: it gets the name of ``path``, in a folder of its own, because the format writes
    its name into the file. Raises InputError: the file cannot be written.
    """
    remove_left_behind(path)
    begin = path.with_name(f"{_prefix(path)}{os.getpid()}")
    temporary = begin.with_name(f"{begin.name}{path.suffix}")
    with _removed_at_end(begin), errors_of(path):
        _remove(begin)
        if has_own_name:
            begin.mkdir()
            temporary = begin / path.name
        yield temporary
        move_into_place(temporary, path)


def remove_temporaries() -> None:
    """Remove what is being written, because the process ends now.

    From now on no `replacing` ends: its writer must not report as an error what is done here.
    """
    _removing.acquire()
    for begin in _begins:
        _remove(begin)


def remove_left_behind(path: Path) -> None:
    """Remove temporary files for a path whose process is no longer there."""
    for other, number in _temporaries(path.with_name(_prefix(path))):
        if number.isdecimal() and _has_ended(int(number)):
            with contextlib.suppress(OSError):
                _discard(other)


@contextlib.contextmanager
def _removed_at_end(begin: Path) -> Iterator[None]:
    """Remove what begins so, however the block or the process ends."""
    _begins.append(begin)
    try:
        yield
    finally:
        with _removing:
            _remove(begin)
            _begins.remove(begin)


def _prefix(path: Path) -> str:
    """Begin of the names of temporary files for a path, on this machine."""
    stem = os.fsencode(path.stem)[:_LONGEST_STEM].decode(errors="ignore")
    return f".{stem}.cubic_craft-{platform.node()}-"


def _remove(begin: Path) -> None:
    """Remove a temporary file, and what writers make beside it on the way, by how they begin.

    Blender writes ``name.blend@`` first, USD ``name.XXXXXX`` with six random characters. Such may
    be made while others are removed.
    """
    with contextlib.suppress(OSError):
        while found := [path for path, rest in _temporaries(begin) if not rest]:
            for path in found:
                _discard(path)


def _discard(path: Path) -> None:
    """Remove a file, a link, or a folder with all that is in it."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def _temporaries(begin: Path) -> Iterator[tuple[Path, str]]:
    """Give files whose names begin so, and what comes then up to the next dot or @."""
    with contextlib.suppress(OSError):
        for path in begin.parent.iterdir():
            if path.name.startswith(begin.name):
                yield path, re.split("[.@]", path.name.removeprefix(begin.name), maxsplit=1)[0]


def _has_ended(process: int) -> bool:
    """Return whether a process of this machine is certainly gone."""
    try:
        if sys.platform != "win32":  # where asking would end it
            os.kill(process, 0)
    except OSError as error:
        return isinstance(error, ProcessLookupError)
    except OverflowError:
        pass
    return False
