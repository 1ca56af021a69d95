# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be refused of a command line before Blender starts, for one file."""

from argparse import Namespace
from pathlib import Path

from .errors import InputError
from .formats import KEEP_VERTICES, LOSE_VERTICES, READABLE, listing
from .output_files import check_writable, numbered, per_cubeness

__all__ = (
    "check_format",
    "check_is_something_to_do",
    "check_mesh_suffix",
    "check_single",
    "check_suffix",
    "refuse_empty",
)


def check_single(options: Namespace) -> None:
    """Check what concerns a run with one file, and fill in what it writes.

    Raises
    ------
    InputError
        The input, an output path, or how options go together.
    """
    for option in ("jobs", "scheduler", "force", "recursive"):
        if getattr(options, option):
            raise InputError(f"--{option}: is for several files; add --output-folder DIR")
    check_is_something_to_do(options)
    if not options.no_render and options.output is None:
        options.output = Path("cubic_craft.png")
    if options.input is not None:
        _check_input(options.input)
    options.save_mesh = Path(options.save_mesh) if options.save_mesh is not None else None
    _check_outputs(options)


def refuse_empty(path: Path) -> None:
    """Refuse a file without content, before Blender starts for it."""
    if not path.stat().st_size:
        raise InputError(f"{path}: the file is empty; export it again")


def check_is_something_to_do(options: Namespace) -> None:
    """Refuse --no-render together with pictures, and without anything else to write."""
    if options.no_render and (options.output or options.turntable):
        raise InputError("--no-render: does not go together with --output or --turntable; drop one")
    if options.no_render and not (options.save_mesh or options.report):
        raise InputError("--no-render: nothing to write; add --save-mesh FILE or --report FILE")


def check_suffix(option: str, path: Path, allowed: tuple[str, ...]) -> None:
    """Refuse an output whose name ends otherwise."""
    if path.suffix.lower() not in allowed:
        raise InputError(f"{option} {path}: the name must end in {listing(allowed)}")


def check_mesh_suffix(option: str, path: Path) -> None:
    """Refuse a mesh in a format that does not keep the vertices."""
    if path.suffix.lower() in LOSE_VERTICES:
        raise InputError(
            f"{option} {path}: this format cannot keep vertex order and count; give "
            f"{listing(KEEP_VERTICES)}"
        )
    check_suffix(option, path, KEEP_VERTICES)


def check_format(path: Path) -> None:
    """Refuse an input in a format that cannot be read."""
    if path.suffix.lower() not in READABLE:
        kind = f"{path.suffix!r} files" if path.suffix else "files without a suffix"
        raise InputError(f"{path}: cannot read {kind}; give {listing(READABLE)}")


def _check_input(path: Path) -> None:
    check_format(path)
    try:
        with path.open("rb"):
            pass
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file; check the path") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from None


def _check_outputs(options: Namespace) -> None:
    """Refuse output paths of the wrong kind, that cannot be written, or that collide."""
    outputs: dict[str, list[Path]] = {}
    if options.output:
        check_suffix("--output", options.output, (".png",))
        outputs["--output"] = numbered(options.output, options.turntable)
    if options.save_mesh:
        check_mesh_suffix("--save-mesh", options.save_mesh)
        outputs["--save-mesh"] = per_cubeness(options.save_mesh, options.cubeness)
    if options.report:
        check_suffix("--report", options.report, (".json",))
        outputs["--report"] = [options.report]
    if options.error_file:
        outputs["--error-file"] = [options.error_file]
    for option, paths in outputs.items():
        check_writable(option, paths)
        for source in (options.input, options.handles_file):
            if source is not None and source.resolve() in (path.resolve() for path in paths):
                raise InputError(f"{option} {source}: this is the input; give another name")
