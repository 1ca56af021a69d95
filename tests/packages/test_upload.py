# SPDX-License-Identifier: GPL-3.0-or-later
"""Each version on the extensions platform has one file for each platform, and its own Blenders."""

import tomllib
from pathlib import Path

import pytest
from made_up import package

from scripts.package.targets import packages_to_upload
from scripts.package.upload import release_of, upload_problems, uploaded_version

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def problems(tmp_path):
    """Return a function that makes the zips of a release, with some fields changed, and checks."""

    def find(changed=(), **fields):
        paths = []
        for number, each in enumerate(packages_to_upload()):
            values = {"version": uploaded_version("1.2.4", each), **each.blender_versions()}
            values |= fields if number in changed else {}
            path = tmp_path / f"{number}.zip"
            paths.append(package(path, {}, platforms=[each.platform.name], **values))
        return upload_problems(paths)

    return find


def test_a_release_is_two_versions_for_ranges_that_meet(problems):
    versions = [uploaded_version("1.2.4", each) for each in packages_to_upload()]
    assert versions == ["1.2.4"] * 3 + ["1.2.5"] * 3
    assert problems() == []


def test_two_files_of_a_version_for_one_platform(problems):
    assert problems([3], version="1.2.4")[0] == "windows-x64 has two files in one version"


@pytest.mark.parametrize("first", ["5.0.0", "5.2.0"])
def test_blenders_with_two_versions_or_with_none(problems, first):
    found = problems([3, 4, 5], blender_version_min=first)
    assert found[0] == "the files for windows-x64 do not meet at one version of Blender"
    assert len(found) == 3


def test_newer_blenders_with_the_older_version(problems):
    found = problems([3, 4, 5], version="1.2.3")
    assert found[0] == "on windows-x64, newer Blenders have the older version"


def test_other_blenders_on_one_platform(problems):
    assert "a version is not for the same Blenders on all platforms" in problems(
        [5], blender_version_min="5.2.0"
    )


def test_the_version_of_the_extension_leaves_the_next_number_free(tmp_path):
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text())
    assert uploaded_version(manifest["version"], packages_to_upload()[0]) == manifest["version"]
    plain = package(tmp_path / "plain.zip", {}, version="1.2.3")
    with pytest.raises(SystemExit, match="last number of a release is even"):
        uploaded_version(release_of(plain), packages_to_upload()[0])
