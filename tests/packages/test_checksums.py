# SPDX-License-Identifier: GPL-3.0-or-later
"""The checksums beside the packages."""

import hashlib

from scripts.package.checksums import write_checksums


def test_each_other_file_has_its_checksum(tmp_path):
    names = ("a b.zip", "b.zip")
    for name in names:
        (tmp_path / name).write_bytes(name.encode())
    for _ in range(2):  # the second time, its own file is there too
        written = write_checksums(tmp_path)
    lines = [f"{hashlib.sha256(name.encode()).hexdigest()}  {name}" for name in names]
    assert written.read_text().splitlines() == lines
