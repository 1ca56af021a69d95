"""What is done already: one small file per input, in the output folder.

It holds the report of the run, the sizes of what was written, and a key: a digest of the input's
content, the options and the version. What has the same key need not be made again.
"""

import hashlib
import json
from argparse import Namespace
from collections.abc import Collection
from pathlib import Path
from typing import Any

from ..output_files import replacing

__all__ = ("key_of", "read_record", "record_path", "write_record")

FOLDER = ".cubic_craft"
NOT_IN_KEY = ("handles_file", "verbose")


def record_path(output_folder: Path, name: str) -> Path:
    """Return where the record of the source of this name is."""
    return output_folder / FOLDER / f"{name}.json"


def key_of(source: Path, options: Namespace, names: Collection[str], version: str) -> str:
    """Return a digest of all that decides about the results.

    Of files that the source refers to (materials, textures, buffers) nothing is in it.

    Parameters
    ----------
    names : the attributes of ``options`` that count
    version : of CubicCraft

    Raises
    ------
    OSError
        A file cannot be read.
    """
    values = {name: getattr(options, name) for name in names if name not in NOT_IN_KEY}
    values["save_mesh"] = options.save_mesh
    digest = hashlib.sha256(json.dumps([version, values], sort_keys=True).encode())
    for path in (source, options.handles_file):
        if path is not None:
            with path.open("rb") as file:
                digest.update(hashlib.file_digest(file, "sha256").digest())
    return digest.hexdigest()


def read_record(path: Path, key: str, outputs: list[Path]) -> dict[str, Any] | None:
    """Return the record, if it has this key and the outputs are as they were written."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["key"] == key and record["sizes"] == _sizes(outputs):
            return record
    except (OSError, ValueError, KeyError, TypeError):
        pass  # there is none, or one that was not completed
    return None


def write_record(path: Path, key: str, outputs: list[Path], seconds: float) -> dict[str, Any]:
    """Complete what the run has written to the path, its report, to a record.

    Raises
    ------
    OSError, ValueError, InputError
        The report or an output is not there, or the record cannot be written.
    """
    report = json.loads(path.read_text(encoding="utf-8"))
    record = {"key": key, "sizes": _sizes(outputs), "seconds": seconds, "report": report}
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")
    return record


def _sizes(outputs: list[Path]) -> dict[str, int]:
    return {path.name: path.stat().st_size for path in outputs}
