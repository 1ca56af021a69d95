# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be refused of a command line before Blender starts."""

from argparse import Namespace
from pathlib import Path

from ....solver.console.output import InputError
from ....solver.console.sources import check_source, listing
from ..process.output_files import check_writable, meshes, numbered
from .formats import ANIMATED, FOR_ENGINES, READABLE, WRITABLE


def check_single(options: Namespace) -> None:
    """Check what concerns a run with one file, and fill in what it writes.

    Raises InputError: the input, an output path, or how options go together.
    """
    for option in ("jobs", "force", "recursive", "only"):
        if getattr(options, option):
            raise InputError(f"--{option}: is for several files; add --output-folder DIR")
    check_form(options)
    _check_bake(options)
    _check_is_something_to_do(options)
    if not options.no_render and options.output is None:
        options.output = Path("cubic_craft.png")
    if options.input is not None:
        _check_input(options.input)
    options.save_mesh = Path(options.save_mesh) if options.save_mesh is not None else None
    _check_outputs(options)


def check_form(options: Namespace) -> None:
    """Check that a form that is made from a file has one and no other has, and FACES directions.

    Raises InputError: it has none, the directions are missing, or the file cannot be read, or that
    of the normal capture.
    """
    needs_file = options.form in ("object", "directions")
    if needs_file and options.form_object is None:
        raise InputError(
            f"--form {options.form}: name the file that it is made from, --form-object FILE"
        )
    if options.form == "faces" and not options.form_directions.strip():
        raise InputError('--form faces: give its directions, --form-directions "0 0 1, 1 0 0"')
    if options.form_object is not None:
        if not needs_file:
            raise InputError("--form-object: is for --form object and --form directions")
        _check_input(options.form_object)
    if options.capture is not None:
        _check_input(options.capture)


def check_batch(options: Namespace) -> None:
    """Check what concerns a batch; what is wrong inside a file is found when its turn comes.

    Raises InputError: an input, an output, or how options go together.
    """
    folder, report = options.output_folder, options.report
    if folder is None:
        what = f"{options.inputs[0]}: is a folder" if len(options.inputs) == 1 else "several files"
        raise InputError(f"{what}: name a folder for the results, --output-folder DIR")
    for is_wrong, message in (
        (
            options.output,
            "--output: is for one file; in --output-folder pictures are named as their inputs",
        ),
        (options.part, "--part: is for one file"),
        (not options.inputs, "--output-folder: give the files, or a folder that holds them, first"),
    ):
        if is_wrong:
            raise InputError(message)
    check_form(options)
    _check_bake(options)
    _check_is_something_to_do(options)
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
    if report:
        _check_suffix("--report", report, (".json",))
        if report.parent.resolve() != folder.resolve():  # which is made later
            check_writable("--report", [report])


def refuse_empty(path: Path) -> None:
    """Refuse a file without content, before Blender starts for it."""
    if not path.stat().st_size:
        raise InputError(f"{path}: the file is empty; export it again")


def _check_bake(options: Namespace) -> None:
    """Check what concerns an animation; it is the only thing that is written then."""
    if not options.bake:
        for option in ("frames", "part"):
            if getattr(options, option):
                raise InputError(f"--{option}: is for --bake FILE")
        return
    for option in ("output", "save_mesh", "turntable", "with_modifiers"):
        if getattr(options, option):
            name = option.replace("_", "-")
            raise InputError(f"--{name}: does not go together with --bake; drop one")
    name = f"name{options.bake}" if options.output_folder else options.bake
    _check_suffix("--bake", Path(name), ANIMATED)
    if len(options.cubeness) > 1:
        raise InputError("--cubeness: an animation has one; run once for each")
    if options.frames and options.frames[0] > options.frames[1]:
        raise InputError("--frames: the last frame comes before the first")
    if options.part and options.part[0] > options.part[1]:
        raise InputError("--part: there is no such part; give its number, then how many there are")
    options.no_render = True


def _check_is_something_to_do(options: Namespace) -> None:
    if options.low_poly and options.save_mesh is None:
        raise InputError(f"--low-poly: add --save-mesh with {listing(FOR_ENGINES)}")
    if options.no_render and (options.output or options.turntable):
        raise InputError("--no-render: does not go together with --output or --turntable; drop one")
    if options.no_render and not (options.save_mesh or options.bake or options.report):
        raise InputError("--no-render: nothing to write; add --save-mesh FILE or --report FILE")


def _check_suffix(option: str, path: Path, allowed: tuple[str, ...]) -> None:
    if path.suffix.lower() not in allowed:
        raise InputError(f"{option} {path}: the name must end in {listing(allowed)}")


def _check_mesh(options: Namespace, path: Path) -> None:
    _check_suffix("--save-mesh", path, WRITABLE)
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


def _check_input(path: Path) -> None:
    check_source(path, READABLE)
    try:
        with path.open("rb"):
            pass
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from None


def _check_outputs(options: Namespace) -> None:
    outputs: dict[str, list[Path]] = {}
    if options.output:
        _check_suffix("--output", options.output, (".png",))
        outputs["--output"] = numbered(options.output, options.turntable)
    if options.save_mesh:
        _check_mesh(options, options.save_mesh)
        outputs["--save-mesh"] = meshes(options.save_mesh, options.cubeness, options.low_poly)
    if options.bake:
        outputs["--bake"] = [options.bake]
    if options.report:
        _check_suffix("--report", options.report, (".json",))
        outputs["--report"] = [options.report]
    for option, paths in outputs.items():
        check_writable(option, paths)
        for source in (options.input, options.handles_file, options.capture):
            if source is not None and source.resolve() in (path.resolve() for path in paths):
                raise InputError(f"{option} {source}: this is the input; give another name")
