# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be refused of a command line before Blender starts."""

from argparse import Namespace
from pathlib import Path

from ....solver.console.output import InputError, check_outputs
from ....solver.console.sources import check_source, check_suffix, listing
from ..process.output_files import meshes, numbered
from .formats import ANIMATED, FOR_ENGINES, READABLE, WRITABLE


def check(options: Namespace) -> None:
    """Check inputs, outputs and how options go together, and fill in what one file writes.

    Of a batch, what is wrong inside a file is found when its turn comes. Raises InputError.
    """
    _check_forms(options)
    _check_bake(options)
    _check_is_something_to_do(options)
    inputs = options.inputs
    if options.output_folder or len(inputs) > 1 or any(path.is_dir() for path in inputs):
        _check_batch(options)
    else:
        _check_single(options)
    if options.report:
        check_suffix(f"--report {options.report}", options.report, (".json",))


def _check_forms(options: Namespace) -> None:
    """Check that a form that is made from a file has one and no other has, and FACES directions."""
    needs_file = options.form in ("object", "directions")
    if needs_file and options.form_object is None:
        raise InputError(
            f"--form {options.form}: name the file that it is made from, --form-object FILE"
        )
    if options.form == "faces" and not options.form_directions.strip():
        raise InputError('--form faces: give its directions, --form-directions "0 0 1, 1 0 0"')
    if options.form_object is not None and not needs_file:
        raise InputError("--form-object: is for --form object and --form directions")
    if options.form_object is not None:
        check_source(options.form_object, READABLE)


def _check_bake(options: Namespace) -> None:
    """Check what concerns an animation; it is the only thing that is written then."""
    if not options.bake:
        if options.frames:
            raise InputError("--frames: is for --bake FILE")
        return
    for option in ("output", "save_mesh", "turntable", "with_modifiers"):
        if getattr(options, option):
            name = option.replace("_", "-")
            raise InputError(f"--{name}: does not go together with --bake; drop one")
    name = f"name{options.bake}" if options.output_folder else options.bake
    check_suffix(f"--bake {name}", Path(name), ANIMATED)
    if len(options.cubeness) > 1:
        raise InputError("--cubeness: an animation has one; run once for each")
    if options.frames and options.frames[0] > options.frames[1]:
        raise InputError("--frames: the last frame comes before the first")
    options.no_render = True


def _check_is_something_to_do(options: Namespace) -> None:
    if options.low_poly and options.save_mesh is None:
        raise InputError(f"--low-poly: add --save-mesh with {listing(FOR_ENGINES)}")
    if options.no_render and (options.output or options.turntable):
        raise InputError("--no-render: does not go together with --output or --turntable; drop one")
    if options.no_render and not (options.save_mesh or options.bake or options.report):
        raise InputError("--no-render: nothing to write; add --save-mesh FILE or --report FILE")


def _check_batch(options: Namespace) -> None:
    folder, report = options.output_folder, options.report
    if folder is None:
        what = f"{options.inputs[0]}: is a folder" if len(options.inputs) == 1 else "several files"
        raise InputError(f"{what}: name a folder for the results, --output-folder DIR")
    if options.output:
        raise InputError(
            "--output: is for one file; in --output-folder pictures are named as their inputs"
        )
    if not options.inputs:
        raise InputError("--output-folder: give the files, or a folder that holds them, first")
    for path in options.inputs:  # a slip of the pen, of which one would hear at the very end
        if not path.is_dir():
            check_source(path, READABLE)
    if options.save_mesh is not None:
        _check_ending("--save-mesh", options.save_mesh)
        _check_mesh(options, Path(f"name{options.save_mesh}"))
    if options.bake is not None:
        _check_ending("--bake", str(options.bake))
    if folder.exists() and not folder.is_dir():
        raise InputError(f"--output-folder {folder}: this is a file; give a folder")
    if report and report.parent.resolve() != folder.resolve():  # which is made later
        check_outputs("--report", [report])


def _check_single(options: Namespace) -> None:
    for option in ("force", "recursive"):
        if getattr(options, option):
            raise InputError(f"--{option}: is for several files; add --output-folder DIR")
    options.input = options.inputs[0] if options.inputs else None
    if options.input is not None:
        check_source(options.input, READABLE)
    outputs: dict[str, list[Path]] = {}
    if not options.no_render:
        options.output = options.output or Path("cubic_craft.png")
        check_suffix(f"--output {options.output}", options.output, (".png",))
        outputs["--output"] = numbered(options.output, options.turntable)
    if options.save_mesh is not None:
        options.save_mesh = Path(options.save_mesh)
        _check_mesh(options, options.save_mesh)
        outputs["--save-mesh"] = meshes(options.save_mesh, options.cubeness, options.low_poly)
    for option, path in (("--bake", options.bake), ("--report", options.report)):
        if path:
            outputs[option] = [path]
    sources = (options.input, options.handles_file, options.form_object)
    for option, paths in outputs.items():
        check_outputs(option, paths, filter(None, sources))


def _check_mesh(options: Namespace, path: Path) -> None:
    check_suffix(f"--save-mesh {path}", path, WRITABLE)
    if options.low_poly and path.suffix.lower() not in FOR_ENGINES:
        raise InputError(f"--low-poly: is for --save-mesh with {listing(FOR_ENGINES)}")


def _check_ending(option: str, ending: str) -> None:
    """Refuse what cannot be the end of a name: ``.obj`` and ``_cubic.obj`` can."""
    if not ending or ending[0].isalnum() or Path(ending).name != ending:
        example = ".obj or _cubic.obj" if option == "--save-mesh" else ".abc or _cubic.abc"
        raise InputError(
            f"{option} {ending}: with several files give how the names of the results shall "
            f"end, such as {example}"
        )
