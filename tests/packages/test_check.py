# SPDX-License-Identifier: GPL-3.0-or-later
"""The check of the packages finds each thing that can be wrong with them, and says what it is."""

import pytest
from made_up import LINUX, NEEDED, PACKAGE, good_wheels, lock_of, package, wheel

from scripts.package.check import check
from scripts.package.targets import PLATFORMS, Package

FAST = "fast-1.0-cp312-abi3-manylinux_2_28_x86_64.whl"


@pytest.fixture
def problems(tmp_path):
    """Return a function that makes a package and returns its problems."""

    def find(wheels, promise=PACKAGE, lock=None, limit=10**6, **others):
        path = package(tmp_path / "package.zip", wheels, **others)
        return check(path, promise, lock or lock_of(wheels), NEEDED, limit)

    return find


def test_a_good_package_has_no_problems(problems):
    assert problems(good_wheels()) == []


def test_a_native_wheel_is_missing(problems):
    wheels = good_wheels()
    del wheels[FAST]
    assert problems(wheels) == ["fast has no wheel for linux-x64, Python 3.13; the solver needs it"]


def test_a_stable_abi_is_not_for_older_pythons(problems):
    assert problems(good_wheels(), promise=Package(LINUX, "3.11")) == [
        f"{FAST} is not for linux-x64, Python 3.11",
        "fast has no wheel for linux-x64, Python 3.11; the solver needs it",
    ]


@pytest.mark.parametrize(
    "tags",
    [
        "cp313-cp313-win_amd64",
        "cp313-cp313-macosx_11_0_arm64",
        "cp313-cp313-manylinux_2_28_aarch64",
        "cp313-cp313-musllinux_1_2_x86_64",
        "cp313-cp313-manylinux_2_34_x86_64",  # a newer C library than Blender asks for
        "cp313-cp313t-manylinux_2_28_x86_64",  # the Python without the lock
        "cp311-cp311-manylinux_2_28_x86_64",
        "cp314-cp314-manylinux_2_28_x86_64",
    ],
)
def test_a_foreign_wheel(problems, tags):
    name, content = wheel("fast", tags)
    wheels = good_wheels() | {name: content}
    assert problems(wheels) == [f"{name} is not for linux-x64, Python 3.13"]


def test_a_dependency_of_a_dependency_is_missing(problems):
    wheels = {name: c for name, c in good_wheels().items() if not name.startswith("deep")}
    assert problems(wheels) == ["deep has no wheel for linux-x64, Python 3.13; plain needs it"]


def test_a_dependency_of_one_platform_counts_there_only(tmp_path):
    wheels = dict([wheel("fast", "py3-none-any"), wheel("plain", "py3-none-any")])
    name, content = wheel("plain", "py3-none-any", requires=["deep; sys_platform == 'win32'"])
    wheels[name] = content
    fields = {"linux-x64": {}, "windows-x64": {"blender_version_min": "5.1.0"}}
    for platform, versions in fields.items():
        path = package(tmp_path / "package.zip", wheels, platforms=[platform], **versions)
        found = check(path, Package(PLATFORMS[platform], "3.13"), lock_of(wheels), NEEDED)
        assert bool(found) == (platform == "windows-x64"), found


def test_a_dependency_has_another_version(problems):
    wheels = good_wheels()
    name, content = wheel("plain", "py3-none-any", requires=["deep>=2"])
    found = problems(wheels | {name: content})
    assert found == ["plain needs deep>=2, not 1.0 (linux-x64, Python 3.13)"]


def test_numpy_inside(problems):
    name, content = wheel("numpy", "cp313-cp313-manylinux_2_28_x86_64")
    assert problems(good_wheels() | {name: content}) == [
        f"{name} would take the place of Blender's own"
    ]


def test_a_wheel_for_another_numpy(problems):
    name, content = wheel("plain", "py3-none-any", requires=["deep", "numpy>=2.3"])
    found = problems(good_wheels() | {name: content})
    assert found == ["plain needs numpy>=2.3, some Blenders have 2.2.4 (linux-x64, Python 3.13)"]


def test_another_file_than_the_locked_one(problems):
    wheels = good_wheels()
    name, changed = wheel("deep", "py2.py3-none-any", files=["deep/changed.py"])
    found = problems(wheels | {name: changed}, lock=lock_of(wheels))
    assert found == [f"{name} is not the locked file of version 1.0"]


def test_a_wheel_that_nobody_locked_or_needs(problems):
    name, content = wheel("other", "py3-none-any")
    found = problems(good_wheels() | {name: content}, lock=lock_of(good_wheels()))
    assert found == [f"{name} is not locked", f"{name} is needed by nothing"]


def test_two_wheels_of_which_blender_installs_one(problems):
    name, content = wheel("fast", "cp313-cp313-manylinux_2_17_x86_64")
    (found,) = problems(good_wheels() | {name: content})
    assert found == f"Blender would install only one of {FAST}, {name} (linux-x64, Python 3.13)"


def test_files_that_older_blenders_do_not_put_in_place(problems):
    name, content = wheel("deep", "py2.py3-none-any", files=["deep-1.0.data/purelib/deep.py"])
    found = problems(good_wheels() | {name: content})
    assert found == [f"{name} has files where older Blenders leave them unfound"]


def test_too_large(problems):
    (found,) = problems(good_wheels(), limit=1000)
    assert found.endswith("bytes, 1,000 or more")


def test_the_manifest_lists_other_wheels(problems):
    wheels = good_wheels()
    listed = [*wheels, "more-1.0-py3-none-any.whl"]
    found = problems(wheels, listed=listed)
    assert found == ["wheels/more-1.0-py3-none-any.whl is in the manifest but not in the zip"]
    listed = [name for name in wheels if name != FAST]
    found = problems(wheels, listed=listed)
    assert found == [f"wheels/{FAST} is in the zip but not in the manifest"]


def test_the_manifest_names_other_platforms(problems):
    assert problems(good_wheels(), platforms=["linux-x64", "macos-arm64"]) == [
        "its platforms are ['linux-x64', 'macos-arm64']"
    ]


@pytest.mark.parametrize("name", ["THIRD_PARTY.md", "sbom.cdx.json"])
def test_a_list_is_missing(problems, name):
    assert problems(good_wheels(), without=[name]) == [f"{name} is missing"]


def test_a_wheel_that_is_not_in_the_bill(problems):
    wheels = good_wheels()
    bill = {name: content for name, content in wheels.items() if not name.startswith("deep")}
    found = problems(wheels, bill=bill)
    assert found == ["deep-1.0-py2.py3-none-any.whl is not in sbom.cdx.json"]


def test_a_licence_text_is_missing(problems):
    found = problems(good_wheels(), without=["licences/deep/LICENSE"])
    assert found == ["there is no licence text of deep"]


def test_a_package_must_say_for_which_blenders_it_is(tmp_path):
    windows = PLATFORMS["windows-x64"]
    wheels = dict([wheel("fast", "cp311-cp311-win_amd64"), wheel("plain", "py3-none-any")])
    old = Package(windows, "3.11")
    fields = {"platforms": ["windows-x64"]}
    path = package(tmp_path / old.file_name("1.2.3"), wheels, **fields)
    assert check(path, None, lock_of(wheels), NEEDED) == [
        "its blender_version_max is None, not 5.1.0"
    ]
    package(path, wheels, blender_version_max="5.1.0", **fields)
    assert check(path, None, lock_of(wheels), NEEDED) == []


def test_a_zip_of_another_name_promises_nothing(tmp_path):
    path = package(tmp_path / "package.zip", good_wheels())
    with pytest.raises(ValueError, match="not the name of a package"):
        check(path)
