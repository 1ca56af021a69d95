# SPDX-License-Identifier: GPL-3.0-or-later
"""What a package is called, and how it is split."""

from made_up import LINUX

from scripts.package.targets import PLATFORMS, Package, all_packages, packages_for

WINDOWS = Package(PLATFORMS["windows-x64"])


def test_a_whole_package_is_for_all_blenders():
    assert WINDOWS.file_name("1.2.3") == "cubic_craft-1.2.3-windows_x64.zip"
    assert WINDOWS.blender_versions() == {}


def test_where_blender_brings_its_python_the_halves_meet_at_one_version():
    old, new = WINDOWS.split()
    assert old.blender_versions() == {"blender_version_max": "5.1.0"}  # the first that is refused
    assert new.blender_versions() == {"blender_version_min": "5.1.0"}


def test_on_linux_the_version_of_blender_does_not_tell_the_python():
    halves = Package(LINUX).split()
    assert [half.blender_versions() for half in halves] == [{}, {}]
    assert halves[1].file_name("1.2.3") == "cubic_craft-1.2.3-linux_x64-python3.13.zip"


def test_the_newest_python_has_packages_and_locks_of_its_own():
    (arm,) = packages_for(PLATFORMS["linux-arm64"])
    whole, newest = packages_for(LINUX)
    assert whole == Package(LINUX)
    assert newest.file_name("1.2.3") == "cubic_craft-1.2.3-linux_x64-python3.14.zip"
    assert arm.file_name("1.2.3") == "cubic_craft-1.2.3-linux_arm64-python3.14.zip"
    assert newest.blender_versions() == arm.blender_versions() == {}
    assert len({package.lock for package in (whole, newest, arm)}) == 3
    assert {half.lock for half in whole.split()} == {whole.lock}


def test_no_two_packages_have_one_name():
    names = [package.file_name("1.2.3") for package in all_packages()]
    assert len(set(names)) == len(names) == 11
