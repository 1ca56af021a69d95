# SPDX-License-Identifier: GPL-3.0-or-later
"""Where both command lines write: checked before, and never left half-written.

A file has a temporary name until it is whole.
"""

import contextlib
import os
import platform
import re
import shutil
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path

from ..errors import CubicCraftError

_LONGEST_STEM = 100  # bytes of it in the name of a temporary file, which must not be too long
_begins: list[Path] = []  # of the temporary files of this process, without suffix
_removing = threading.Lock()


class InputError(ValueError):
    """Something the user gave cannot be used.

    The message is one line: it names the option or file, the reason and the cure.
    """


def check_place(name: str, path: Path) -> None:
    """Refuse what is a folder, or lies in none; `name` is what messages call it.

    Raises InputError.
    """
    if path.is_dir():
        raise InputError(f"{name}: this is a folder; give the name of a file")
    if not path.parent.is_dir():
        raise InputError(f"{name}: the folder {path.parent} does not exist; create it")


def check_folder(name: str, folder: Path) -> None:
    """Refuse a folder that cannot be written to; `name` is what messages call the file.

    Raises InputError.
    """
    try:
        # Trying is the only check that holds on network drives and read-only mounts alike.
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = error.strerror or error
        message = f"{name}: cannot write to {folder} ({reason}); choose another folder"
        raise InputError(message) from error


@contextlib.contextmanager
def errors_of(path: Path) -> Iterator[None]:
    """Raise an InputError for an OSError of a block that writes a file."""
    try:
        yield
    except OSError as error:
        message = f"{path}: cannot be written ({error.strerror or error}); choose another path"
        raise InputError(message) from error


@contextlib.contextmanager
def refusals_of(what: object) -> Iterator[None]:
    """Raise an InputError for a CubicCraftError of a block; `what` is what its message is about."""
    try:
        yield
    except CubicCraftError as error:
        raise InputError(f"{what}: {error}") from error


def move_into_place(temporary: Path, path: Path) -> None:
    """Move what has been written to where it belongs.

    Raises InputError: nothing has been written.
    """
    if not temporary.is_file() or not temporary.stat().st_size:
        raise InputError(f"{path}: nothing was written; is the disk full?")
    temporary.replace(path)


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
