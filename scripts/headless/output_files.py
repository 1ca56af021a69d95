"""Output files: checked before any work is done, and never left half-written."""

import contextlib
import os
import platform
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from .errors import InputError

__all__ = ("check_writable", "numbered", "per_cubeness", "remove_temporaries", "replacing")

_LONGEST_STEM = 100  # bytes of it in the name of a temporary file, which must not be too long
_temporaries: list[Path] = []


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
    relative paths stay right, and it is removed however the block ends. What runs that were killed
    have left of the same file is removed as well.
    """
    _remove_left_behind(path)
    temporary = path.with_name(f"{_prefix(path)}{os.getpid()}{path.suffix}")
    _temporaries.append(temporary)
    try:
        yield temporary
        if not temporary.is_file() or not temporary.stat().st_size:
            raise InputError(f"{path}: nothing was written; is the disk full?")
        temporary.replace(path)
    except OSError as error:
        message = f"{path}: cannot be written ({error.strerror or error}); choose another path"
        raise InputError(message) from error
    finally:
        _remove(temporary)
        _temporaries.remove(temporary)


def remove_temporaries() -> None:
    """Remove what is being written, because the process ends now."""
    for temporary in _temporaries:
        _remove(temporary)


def _prefix(path: Path) -> str:
    """Begin of the names of temporary files for a path, on this machine."""
    stem = path.stem.encode()[:_LONGEST_STEM].decode(errors="ignore")
    return f".{stem}.cubic_craft-{platform.node()}-"


def _remove(temporary: Path) -> None:
    """Remove a temporary file; Blender writes a .blend under its name with an @ first."""
    for path in (temporary, temporary.with_name(f"{temporary.name}@")):
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)


def _remove_left_behind(path: Path) -> None:
    """Remove temporary files for a path whose process is no longer there."""
    prefix = _prefix(path)
    with contextlib.suppress(OSError):
        for other in path.parent.iterdir():
            process = other.name.removeprefix(prefix).removesuffix("@").removesuffix(path.suffix)
            if other.name.startswith(prefix) and process.isdecimal() and _has_ended(int(process)):
                _remove(other)


def _has_ended(process: int) -> bool:
    """Tell whether a process of this machine is certainly gone."""
    if sys.platform == "win32":
        return False  # asking would end it there
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError):
        return False
    return False
