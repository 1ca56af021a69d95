# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the artist are written beside their place, and moved there when they are complete."""

import contextlib
from collections.abc import Iterator
from pathlib import Path

from .lock import Lock


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give another path in the same folder, with the same suffix, whose file becomes this one.

    After an exception, an earlier file is left as it was, and nothing else.

    Raises BusyError: another process writes it.
    """
    partial = path.with_name(f".part-{path.name}")
    lock = Lock(path)
    try:
        yield partial
        partial.replace(path)
    finally:
        with contextlib.suppress(OSError):
            partial.unlink(missing_ok=True)
        lock.release()
