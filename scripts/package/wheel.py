# SPDX-License-Identifier: GPL-3.0-or-later
"""A wheel, read once: what its name and its metadata say, and its licence texts."""

import hashlib
import re
import zipfile
from dataclasses import dataclass
from email.message import Message
from email.parser import BytesParser
from pathlib import PurePosixPath

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name, parse_wheel_filename

_LICENCE = re.compile(r"(licen[cs]e|copying|notice|authors)[^/]*$", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Wheel:
    """`tags` as in the name of the file; `files` are the names inside."""

    file_name: str
    name: str
    version: str
    tags: frozenset
    metadata: Message
    files: tuple[str, ...]
    licences: dict[str, str]
    sha256: str

    @classmethod
    def read(cls, file_name, file):
        """Read from an open, seekable file.

        Raises
        ------
        ValueError
            The name is not that of a wheel, or there is no metadata.
        """
        name, version, _, tags = parse_wheel_filename(file_name)
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
        with zipfile.ZipFile(file) as archive:
            files = tuple(archive.namelist())
            metadata = next((f for f in files if _in_info(f, "METADATA")), None)
            if metadata is None:
                raise ValueError(f"{file_name} has no metadata")
            texts = {
                PurePosixPath(f).name: archive.read(f).decode("utf-8", "replace")
                for f in files
                if ".dist-info/" in f and _LICENCE.search(f)
            }
            message = BytesParser().parsebytes(archive.read(metadata))
        return cls(file_name, name, str(version), tags, message, files, texts, sha256)

    @classmethod
    def of_path(cls, path):
        """Read a file."""
        with path.open("rb") as file:
            return cls.read(path.name, file)

    @property
    def is_native(self):
        """Whether it holds machine code, and works on some platforms only."""
        return all(tag.platform != "any" for tag in self.tags)

    @property
    def misplaced(self):
        """Names of files that older Blenders (4.3) do not put where Python finds them."""
        return [f for f in self.files if re.match(r"[^/]+\.data/(purelib|platlib)/", f)]

    def fits(self, platform, python):
        """Return whether this Python can import it on this platform."""
        return not self.tags.isdisjoint(platform.tags(python))

    def requirements(self, platform, python):
        """Return the requirements that hold there, without those of extras."""
        found = map(Requirement, self.metadata.get_all("Requires-Dist", []))
        return holding(found, platform, python)


def holding(requirements, platform, python):
    """Return those of the requirements that hold there."""
    markers = platform.markers(python)
    return [r for r in requirements if r.marker is None or r.marker.evaluate(markers)]


def requirement_name(requirement):
    """Return the normalised name of a requirement."""
    return canonicalize_name(requirement.name)


def _in_info(name, file):
    return name.count("/") == 1 and name.endswith(f".dist-info/{file}")
