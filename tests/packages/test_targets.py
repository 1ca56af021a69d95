# SPDX-License-Identifier: GPL-3.0-or-later
"""What a package is called, and for which Blenders it says it is."""

from made_up import LINUX

from scripts.package.targets import PLATFORMS, all_packages, packages_for, packages_to_upload


def test_where_blender_brings_its_python_two_packages_meet_at_one_version():
    for name in ("windows-x64", "macos-arm64"):
        old, new = packages_for(PLATFORMS[name])
        assert old.blender_versions() == {"blender_version_max": "5.1.0"}  # the first refused
        assert new.blender_versions() == {"blender_version_min": "5.1.0"}
        assert new.file_name("1.2.3").endswith("-blender5.1_or_newer.zip")


def test_on_linux_the_version_of_blender_does_not_tell_the_python():
    packages = packages_for(LINUX)
    assert [package.blender_versions() for package in packages] == [{}, {}, {}]
    assert packages[1].file_name("1.2.3") == "cubic_craft-1.2.3-linux_x64-python3.13.zip"


def test_the_newest_python_has_packages_and_locks_of_its_own():
    (arm,) = packages_for(PLATFORMS["linux-arm64"])
    old, new, newest = packages_for(LINUX)
    assert newest.file_name("1.2.3") == "cubic_craft-1.2.3-linux_x64-python3.14.zip"
    assert arm.file_name("1.2.3") == "cubic_craft-1.2.3-linux_arm64-python3.14.zip"
    assert newest.blender_versions() == arm.blender_versions() == {}
    assert len({package.lock for package in (new, newest, arm)}) == 3
    assert old.lock == new.lock


def test_what_is_uploaded_says_on_linux_too_for_which_blenders_it_is():
    uploaded = packages_to_upload()
    assert len(uploaded) == 6
    assert all(package.blender_versions() for package in uploaded)
    assert not {package.platform.name for package in uploaded} - set(PLATFORMS)


def test_no_two_packages_have_one_name():
    names = [package.file_name("1.2.3") for package in all_packages()]
    assert len(set(names)) == len(names) == 10
