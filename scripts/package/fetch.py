# SPDX-License-Identifier: GPL-3.0-or-later
"""Get the locked wheels: from the cache, or else by pip, which checks the hashes."""

from . import pip
from .locked import read_lock
from .wheel import Wheel


def fetch(platform, python, cache, lock):
    """Return the path of each wheel of a lock (Path) for this platform and Python.

    What is in the cache is used only with the locked hash, so a file cut short is fetched again.

    Raises
    ------
    SystemExit
        Something could not be downloaded, or has another hash.
    """
    folder = cache / f"{platform.name}-python{python}"
    locked = read_lock(lock)
    found = _cached(folder, locked)
    if len(found) < len(locked):
        options = ["--no-deps", "--require-hashes", f"--dest={folder}", "-r", lock]
        pip.run("download", platform, python, *options)
        found = _cached(folder, locked)
    missing = locked.keys() - found
    if missing:
        raise SystemExit(f"pip has not brought {', '.join(sorted(missing))} as locked")
    return [found[name] for name in sorted(locked)]


def _cached(folder, locked):
    found = {}
    for path in sorted(folder.glob("*.whl")):
        try:
            wheel = Wheel.of_path(path)
        except Exception:  # cut short or damaged: whatever it is, pip gets it again
            path.unlink()
            continue
        version, hashes = locked.get(wheel.name, (None, ()))
        if wheel.sha256 in hashes and wheel.version == version:
            found[wheel.name] = path
    return found
