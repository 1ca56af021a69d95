# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify meshes without a window: pictures, meshes and a report.

Runs under the ``bpy`` module and in Blender alike::

    python scripts/headless_render.py bunny.obj --cubeness 0.2 0.4
    blender -b -P scripts/headless_render.py -- bunny.obj --cubeness 0.2 0.4
    python scripts/headless_render.py meshes --output-folder cubic --jobs 2
"""

import os
import sys
import time
from argparse import Namespace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
if str(ROOT / "scripts") not in sys.path:  # Blender does not put a script's folder there
    sys.path.insert(0, str(ROOT / "scripts"))

from headless.arguments import parse  # noqa: E402
from headless.batch.run import run_batch  # noqa: E402
from headless.checks import refuse_empty  # noqa: E402
from headless.errors import InputError  # noqa: E402
from headless.extension import read_version  # noqa: E402
from headless.interruption import before_ending, end_on_signals, end_with_input  # noqa: E402
from headless.one_line import one_line  # noqa: E402
from headless.output_files import remove_left_behind, replacing, written  # noqa: E402
from headless.quiet import mute_stdout  # noqa: E402
from headless.threads import thread_variables  # noqa: E402
from headless.watched_process import Limits, end_processes, finish, start  # noqa: E402

IS_INSIDE_BLENDER = "bpy" in sys.modules
PROGRAM = "headless_render.py"


def arguments_of_script() -> list[str]:
    """Return the script's own arguments; in Blender those behind ``--``."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    return [] if IS_INSIDE_BLENDER else sys.argv[1:]


def command_of_worker(threads: int | None) -> list[str]:
    """Return what starts this script once more, by Python or the same Blender."""
    if not IS_INSIDE_BLENDER:
        return ["", str(Path(__file__).resolve())]  # by the Python of whoever starts it
    import bpy

    # As this Blender was started; of two numbers of threads it takes the later.
    own = sys.argv[1 : sys.argv.index("--")]
    limit = ["--threads", str(threads)] if threads else []
    return [bpy.app.binary_path, *limit, "--python-exit-code", "1", *own, "--"]


def leave(code: int) -> None:
    """End the process.

    Blender 4.2 as a Python module crashes while it is freed, if property groups with callbacks were
    ever registered: it keeps the callbacks, and with them itself.
    """
    bpy = sys.modules.get("bpy")
    if bpy is not None and not IS_INSIDE_BLENDER and bpy.app.version < (4, 3):
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


def main() -> int:
    """Do what the command line says, and return the exit code."""
    end_on_signals(PROGRAM)
    begin = time.perf_counter()
    try:
        options = parse(arguments_of_script())
        if options.worker or options.limited:
            end_with_input()
        mute_stdout(options.verbose)
        if options.output_folder:
            return run_batch(options, command_of_worker, read_version(ROOT), PROGRAM, begin)
        return run_one(options, begin)
    except InputError as error:
        print(f"{PROGRAM}: error: {one_line(str(error))}", file=sys.stderr)
        return 2


def run_one(options: Namespace, begin: float) -> int:
    """Run with one file, or the monkey; with --error-file say there why it cannot be used.

    Returns the exit code.
    """
    try:
        if options.input is not None:
            refuse_empty(options.input)
        if (options.timeout or options.memory) and not options.limited:
            return run_limited(options)
        os.environ.update(thread_variables(options.threads))
        # Late, because it takes Blender a second to start: --help and mistyped options need none.
        from headless.pipeline import run

        run(options, ROOT, begin)
        if options.error_file:
            options.error_file.unlink(missing_ok=True)
    except InputError as error:
        if not options.error_file:
            raise
        print(f"{PROGRAM}: {one_line(str(error))}", file=sys.stderr)
        with replacing(options.error_file) as temporary:
            temporary.write_text(f"{error}\n", encoding="utf-8")
    return 0


def run_limited(options: Namespace) -> int:
    """Run with one file in another process, and return its exit code.

    Raises
    ------
    InputError
        It has exceeded a limit.
    """
    before_ending(end_processes)
    command = [word or sys.executable for word in command_of_worker(options.threads)]
    process = start([*command, *arguments_of_script(), "--limited"])
    exceeded = finish(process, Limits(options.timeout, options.memory))
    pictures_and_meshes = (options.output, options.turntable, options.save_mesh, options.cubeness)
    for path in (*written(*pictures_and_meshes), options.bake, options.report):
        if path is not None:
            remove_left_behind(path)
    if exceeded:
        raise InputError(f"{options.input or 'monkey'}: {exceeded}")
    code = process.returncode
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    leave(main())
