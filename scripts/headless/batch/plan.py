"""What is to be written for each file of a batch, and by which command line."""

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

from ..arguments import as_arguments
from ..errors import InputError
from ..output_files import numbered, per_cubeness
from .records import record_path
from .sources import Source

__all__ = ("FORWARDED", "Job", "plan")

FORWARDED = (
    *("object", "cubeness", "orientation", "space", "pin", "handles_file", "map"),
    *("solidity", "together", "refine", "rotation", "symmetry", "floor", "hold_rest"),
    "with_modifiers",
    *("max_iterations", "tolerance", "device"),
    *("engine", "samples", "resolution", "turn", "turntable", "no_render", "verbose"),
)
"""the options that are the same for each file"""


@dataclass(frozen=True)
class Job:
    """One file of a batch."""

    source: Source
    outputs: list[Path]
    """all that is written: pictures, then meshes"""
    record: Path
    """where the numbers of the run and the key of its making are kept"""
    arguments: list[str]
    """of the process that does it"""


def plan(options: Namespace, sources: list[Source]) -> list[Job]:
    """Return one job per source, in the same order.

    Raises
    ------
    InputError
        A result would take the place of an input, or be taken for one the next time.
    """
    jobs = [_job(options, source) for source in sources]
    inputs = {job.source.path.resolve() for job in jobs}
    if options.handles_file:
        inputs.add(options.handles_file.resolve())
    for job in jobs:
        for path in job.outputs:
            if path.resolve() in inputs:
                raise InputError(f"{path}: is an input; choose another --output-folder")
    folders = {path.resolve() for path in options.inputs if path.is_dir()}
    if options.save_mesh and options.output_folder.resolve() in folders:
        raise InputError(
            f"--output-folder {options.output_folder}: is the folder of the inputs as well, where "
            "the meshes would be inputs the next time; choose another, it may lie in this one"
        )
    return jobs


def _job(options: Namespace, source: Source) -> Job:
    begin = options.output_folder.resolve() / source.name
    pictures, meshes = [], []
    arguments = [str(source.path), *as_arguments(options, FORWARDED)]
    if not options.no_render:
        picture = begin.with_name(f"{begin.name}.png")
        arguments.append(f"--output={picture}")
        pictures = numbered(picture, options.turntable)
    if options.save_mesh:
        mesh = begin.with_name(f"{begin.name}{options.save_mesh}")
        arguments.append(f"--save-mesh={mesh}")
        meshes = per_cubeness(mesh, options.cubeness)
    record = record_path(options.output_folder.resolve(), source.name)
    arguments += [f"--report={record}", "--worker"]
    return Job(source, pictures + meshes, record, arguments)
