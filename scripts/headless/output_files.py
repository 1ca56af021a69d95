"""Output files: checked before any work is done, and never left half-written."""

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from .errors import InputError

__all__ = ("check_writable", "numbered", "per_cubeness", "replacing")


def per_cubeness(path: Path, cubeness: list[float]) -> list[Path]:
    """One path per cubeness: the path itself for one value, else ``name_0.4.obj`` and so on."""
    if len(cubeness) == 1:
        return [path]
    return [path.with_name(f"{path.stem}_{value!r}{path.suffix}") for value in cubeness]


def numbered(path: Path, count: int) -> list[Path]:
    """Paths of a sequence: ``name_0001.png`` and so on; the path itself for a count of 0."""
    if not count:
        return [path]
    return [path.with_name(f"{path.stem}_{n:04d}{path.suffix}") for n in range(1, count + 1)]


def check_writable(option: str, paths: list[Path]) -> None:
    """Refuse paths that cannot be written, before the long work starts.

    Raises
    ------
    InputError
        Naming the option, the path and the cure.
    """
    for path in paths:
        if path.is_dir():
            raise InputError(f"{option} {path}: this is a folder; give the name of a file")
        if not path.parent.is_dir():
            raise InputError(f"{option} {path}: the folder {path.parent} does not exist; create it")
    folder = paths[0].parent
    try:
        # Trying is the only check that holds on network drives and read-only mounts alike.
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = error.strerror or error
        message = f"{option} {paths[0]}: cannot write to {folder} ({reason}); choose another folder"
        raise InputError(message) from error


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside ``path`` and move it there if the block succeeds.

    The temporary file has the same suffix and folder, so that exporters see the right format and
    relative paths stay right, and it is removed however the block ends.
    """
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield temporary
        if not temporary.is_file() or not temporary.stat().st_size:
            raise InputError(f"{path}: nothing was written; is the disk full?")
        temporary.replace(path)
    except OSError as error:
        message = f"{path}: cannot be written ({error.strerror or error}); choose another path"
        raise InputError(message) from error
    finally:
        temporary.unlink(missing_ok=True)
