# SPDX-License-Identifier: GPL-3.0-or-later
"""Write why an input cannot be used to a file, for those who look at results only."""

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path

from .errors import InputError
from .output_files import replacing

__all__ = ("errors_written",)


@contextlib.contextmanager
def errors_written(path: Path | None, program: str) -> Iterator[None]:
    """Let an InputError of the block end in the file, if there is a path.

    A file of an earlier run is removed when the block succeeds.

    Raises
    ------
    InputError
        That of the block without a path; with one, if the file cannot be written.
    """
    if path is None:
        yield
        return
    try:
        yield
        path.unlink(missing_ok=True)
    except InputError as error:
        print(f"{program}: {error}", file=sys.stderr)
        with replacing(path) as temporary:
            temporary.write_text(f"{error}\n", encoding="utf-8")
