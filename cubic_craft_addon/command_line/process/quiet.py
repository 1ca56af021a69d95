# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep Blender's own chatter away from the terminal.

Blender prints from C to the file descriptors 1 and 2, past ``sys.stdout`` and ``sys.stderr``, so
it is caught there.
"""

import contextlib
import os
import sys
import tempfile
from collections.abc import Iterator

_terminals = [2]
_verbose = [False]


def mute_stdout(verbose: bool) -> None:
    """Send all later standard output to nowhere; if `verbose`, show it all, on standard error."""
    sys.stdout.flush()
    _verbose[:] = [verbose]
    if verbose:
        os.dup2(2, 1)
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)


def terminal() -> int:
    """Return the file descriptor of standard error, also while that is `captured`."""
    return _terminals[-1]


@contextlib.contextmanager
def captured() -> Iterator[None]:
    """Swallow standard error during the block, unless all is shown (see `mute_stdout`)."""
    if _verbose[0]:
        yield
        return
    sys.stderr.flush()
    _terminals.append(os.dup(2))
    with tempfile.TemporaryFile() as sink:
        os.dup2(sink.fileno(), 2)
        try:
            yield
        finally:
            sys.stderr.flush()
            os.dup2(_terminals[-1], 2)
            os.close(_terminals.pop())


def one_line(text: str) -> str:
    """Return a text, such as a file's name, as it can be printed in one line."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
