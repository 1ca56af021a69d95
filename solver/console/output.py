# SPDX-License-Identifier: GPL-3.0-or-later
"""Where both command lines write: checked before, and never left half-written.

A file has a temporary name until it is whole.
"""

import contextlib
import os
import platform
import re
import shutil
import stat
import sys
import tempfile
import threading
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

from ..errors import CubicCraftError

_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_LONGEST_STEM = 100  # bytes of it in the name of a temporary file, which must not be too long
_begins: list[Path] = []  # of the temporary files of this process, without suffix
_removing = threading.Lock()


class InputError(ValueError):
    """Something the user gave cannot be used.

    The message is one line: it names the option or file, the reason and the cure.
    """


def check_outputs(option: str, paths: Sequence[Path], inputs: Iterable[Path] = ()) -> None:
    """Refuse files of one folder that cannot be written, or are inputs, before the work starts.

    `option`: what has named them. Raises InputError: naming the option, the path and the cure.
    """
    sources = {path.resolve() for path in inputs}
    for path in paths:
        if reason := _why_not(path, sources):
            raise InputError(f"{option} {path}: {reason}".lstrip())
    folder = paths[0].parent
    try:
        # Trying is the only check that holds on network drives and read-only mounts alike.
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = f"cannot write to {folder} ({error.strerror or error}); choose another folder"
        raise InputError(f"{option} {paths[0]}: {reason}".lstrip()) from error


def _why_not(path: Path, sources: Collection[Path]) -> str:
    if path.is_dir():
        return "this is a folder; give the name of a file"
    if not path.parent.is_dir():
        return f"the folder {path.parent} does not exist; create it"
    if path.is_symlink():
        return "this is a link, which is not replaced; give another name"
    if path.exists() and not path.is_file():
        return "this is a device or a pipe; give a file"
    if path.exists() and not path.stat().st_mode & _WRITABLE:
        return "this file is write-protected; give another name"
    return "this is an input; give another name" if path.resolve() in sources else ""


@contextlib.contextmanager
def refusals_of(what: object) -> Iterator[None]:
    """Raise an InputError for a CubicCraftError of a block; `what` is what its message is about."""
    try:
        yield
    except CubicCraftError as error:
        raise InputError(f"{what}: {error}") from error


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
    _remove_left_behind(path)
    begin = path.with_name(f"{_prefix(path)}{os.getpid()}")
    temporary = begin.with_name(f"{begin.name}{path.suffix}")
    with _removed_at_end(begin):
        try:
            _remove(begin)
            if has_own_name:
                begin.mkdir()
                temporary = begin / path.name
            yield temporary
            if not temporary.is_file() or not temporary.stat().st_size:
                raise InputError(f"{path}: nothing was written; is the disk full?")
            temporary.replace(path)
        except OSError as error:
            reason = error.strerror or error
            message = f"{path}: cannot be written ({reason}); choose another path"
            raise InputError(message) from error


def remove_temporaries() -> None:
    """Remove what is being written, because the process ends now.

    From now on no `replacing` ends: its writer must not report as an error what is done here.
    """
    _removing.acquire()
    for begin in _begins:
        _remove(begin)


def _remove_left_behind(path: Path) -> None:
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
