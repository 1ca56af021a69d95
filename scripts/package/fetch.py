# SPDX-License-Identifier: GPL-3.0-or-later
"""Get the locked wheels of another platform by pip, which checks their hashes and keeps them."""

import subprocess
import sys


def fetch(package, folder):
    """Download the wheels of a Package into a folder (Path); return their paths, by name.

    Raises SystemExit: something could not be downloaded, or has another hash. pip has said what.
    """
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
    command += ["--no-deps", "--require-hashes", "--only-binary=:all:", "--implementation=cp"]
    command += [f"--python-version={package.python}", "-r", package.lock, f"--dest={folder}"]
    command += [f"--platform={tag}" for tag in package.platform.wheel_tags]
    if subprocess.run(list(map(str, command)), check=False).returncode:
        raise SystemExit(f"no wheels for {package.platform.name}, Python {package.python}")
    return sorted(folder.glob("*.whl"))
