# SPDX-License-Identifier: GPL-3.0-or-later
"""Have pip resolve and download wheels for other platforms than this one."""

import subprocess
import sys


def run(command, platform, python, *arguments):
    """Run a command of pip for a platform and a Python; return its standard output.

    Raises
    ------
    SystemExit
        pip failed; what it says has been shown.
    """
    for_target = ["--only-binary=:all:", "--implementation=cp", f"--python-version={python}"]
    for_target += [f"--platform={tag}" for tag in platform.wheel_tags]
    options = ["--quiet", "--disable-pip-version-check", "--no-input"]
    done = subprocess.run(
        [sys.executable, "-m", "pip", command, *options, *for_target, *map(str, arguments)],
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise SystemExit(f"pip found no wheels for {platform.name}, Python {python}")
    return done.stdout
