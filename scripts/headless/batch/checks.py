# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be refused of a command line before any work is done, for several files."""

from argparse import Namespace
from pathlib import Path

from ..checks import check_format, check_is_something_to_do, check_mesh_suffix, check_suffix
from ..errors import InputError
from ..output_files import check_writable

__all__ = ("check_batch",)


def check_batch(options: Namespace) -> None:
    """Check what concerns a batch; what is wrong inside a file is found when its turn comes.

    Raises
    ------
    InputError
        An input, an output, or how options go together.
    """
    if options.output_folder is None:
        what = "several files"
        if len(options.inputs) == 1:
            what = f"{options.inputs[0]}: is a folder"
        raise InputError(f"{what}: name a folder for the results, --output-folder DIR")
    if options.output is not None:
        raise InputError(
            "--output: is for one file; in --output-folder pictures are named as their inputs"
        )
    if options.error_file is not None:
        raise InputError("--error-file: is for one file; here --report has all that failed")
    if not options.inputs:
        raise InputError("--output-folder: give the files, or a folder that holds them, first")
    if options.jobs and options.scheduler:
        raise InputError("--jobs: a cluster does as many at a time as it has workers; drop it")
    check_is_something_to_do(options)
    if options.handles_file:
        options.handles_file = options.handles_file.absolute()  # workers may be started elsewhere
    for path in options.inputs:
        _check_input(path)
    if options.save_mesh is not None:
        _check_ending(options.save_mesh)
    if options.output_folder.exists() and not options.output_folder.is_dir():
        raise InputError(f"--output-folder {options.output_folder}: this is a file; give a folder")
    if options.report:
        check_suffix("--report", options.report, (".json",))
        # It may lie in the output folder, which is made later.
        if options.report.parent.resolve() != options.output_folder.resolve():
            check_writable("--report", [options.report])


def _check_input(path: Path) -> None:
    """Refuse a slip of the pen; it would be a pity to hear of it only when all else is done."""
    if path.is_dir():
        return
    if not path.exists():
        raise InputError(f"{path}: there is no such file or folder; check the path")
    check_format(path)


def _check_ending(ending: str) -> None:
    """Refuse what cannot be the end of a name: ``.obj`` and ``_cubic.obj`` can."""
    if not ending or ending[0].isalnum() or Path(ending).name != ending:
        raise InputError(
            f"--save-mesh {ending}: with several files give how the names of the results shall "
            "end, such as .obj or _cubic.obj"
        )
    check_mesh_suffix("--save-mesh", Path(f"name{ending}"))
