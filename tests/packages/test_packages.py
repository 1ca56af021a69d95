# SPDX-License-Identifier: GPL-3.0-or-later
"""What packages are called, which wheels they lock, and whom they credit."""

import zipfile

import pytest
from packaging.requirements import Requirement

from scripts.package.targets import PLATFORMS, REQUIREMENTS, packages_for, packages_to_upload
from scripts.package.third_party import copyright_lines, credit, write_third_party

ALL = [package for platform in PLATFORMS.values() for package in packages_for(platform)]
TEXT = "MIT License\n\nCopyright (c) 2020-2026 The Makers\n"


def wheel(folder, name, fields=("License: MIT",), texts=("LICENSE",), files=()):
    """Write a wheel of our own making, and return its path."""
    path = folder / f"{name}-1.0-py3-none-any.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(f"{name}-1.0.dist-info/METADATA", "\n".join([f"Name: {name}", *fields]))
        for text in texts:
            archive.writestr(f"{name}-1.0.dist-info/licenses/{text}", TEXT)
        for file in files:
            archive.writestr(file, "")
    return path


def test_each_package_has_a_name_of_its_own_that_says_for_which_blenders_it_is():
    names = [package.file_name("1.2.3") for package in (*ALL, *packages_to_upload())]
    assert len(ALL) == 8 and len(set(names)) == 10
    for package in ALL:
        versions, name = package.blender_versions(), package.file_name("1.2.3")
        if package.platform.name.startswith("linux"):
            assert versions == {} and name.endswith(f"-python{package.python}.zip")
        elif package.python == "3.11":
            assert versions == {"blender_version_max": "5.1.0"}  # the first that is refused
            assert name.endswith("-blender4.2_to_5.0.zip")
        else:
            assert versions == {"blender_version_min": "5.1.0"}
            assert name.endswith("-blender5.1_or_newer.zip")


def test_a_release_is_two_versions_on_the_extensions_platform():
    uploaded = packages_to_upload()
    assert [each.uploaded_version("1.2.4") for each in uploaded] == ["1.2.4"] * 3 + ["1.2.5"] * 3
    assert all(each.blender_versions() for each in uploaded)
    with pytest.raises(SystemExit, match="last number of a release is even"):
        uploaded[0].uploaded_version("1.2.3")


@pytest.mark.parametrize("package", ALL, ids=lambda each: each.file_name("x"))
def test_what_the_solver_needs_is_locked(package):
    """The version of each requirement that holds there, with hashes; and no NumPy."""
    here = {
        "python_version": package.python,
        "platform_machine": "aarch64" if "arm64" in package.lock.name else "x86_64",
    }
    lines = (REQUIREMENTS / "solver.txt").read_text().splitlines()
    needed = [Requirement(line.partition("#")[0]) for line in lines if not line.startswith("#")]
    expected = {f"{r.name}{r.specifier}" for r in needed if not r.marker or r.marker.evaluate(here)}
    locked = [line.partition(" ") for line in package.lock.read_text().splitlines() if "==" in line]
    assert expected <= {name for name, *_ in locked}
    assert "sha256:" in package.lock.read_text()
    assert not any(name.startswith("numpy==") for name, *_ in locked)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("Copyright (c) 2010 Jo Doe", "2010 Jo Doe"),
        ("  Copyright 2001-2003, Doe, Inc.", "2001-2003 Doe, Inc."),
        (" * copyright (C) 2001, 2004 by Doe <doe@example.org>.", "2001-2004 Doe"),
        ("Copyright © 2020 Doe and\n            Son. All rights reserved.", "2020 Doe and Son"),
    ],
)
def test_copyrights_as_the_manifest_wants_them(line, expected):
    assert copyright_lines(f"Text.\n{line}\nText.") == [expected]


def test_all_that_is_bundled_is_credited(tmp_path):
    wheels = [wheel(tmp_path, "plain"), wheel(tmp_path, "scipy", files=["a/libdevice.bc"])]
    write_third_party(tmp_path, wheels)
    text = (tmp_path / "THIRD_PARTY.md").read_text()
    assert "## plain 1.0\n\n- Licence: MIT\n- Copyright 2020-2026 The Makers" in text
    assert "- Inside it: HiGHS (MIT)" in text
    assert (tmp_path / "licences" / "plain" / "LICENSE").read_text() == TEXT
    assert (tmp_path / "licences" / "scipy" / "NVIDIA_CUDA_TOOLKIT.txt").exists()


@pytest.mark.parametrize(
    ("wanted", "others"),
    [("licence", {"fields": ["License: of its own"]}), ("copyright", {"texts": ()})],
)
def test_what_nothing_is_known_of_is_not_bundled(tmp_path, wanted, others):
    with pytest.raises(ValueError, match=wanted):
        credit(wheel(tmp_path, "unknown", **others))
