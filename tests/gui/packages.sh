#!/bin/bash
# Packages that bring their wheels, in Debian's Blenders: installed from an extension repository and
# updated (4.3), installed from disk, and refused by another Python than theirs (5.2).
#   packages.sh [--if-possible] PACKAGES [OUTPUT [SUITE...]]
#     PACKAGES   folder of the packages (make package)
#     OUTPUT     folder for screenshots and logs (default: build/packages in the project)
#     SUITE      trixie, sid (default: both)
# PYTHON is one with bpy (default: that of the project's .venv). Needs root on Debian, as run.sh does.
# --if-possible: where they cannot run, say so and succeed.
# Exit codes: 0 all passed, 1 something failed, 2 wrong options or cannot run here.
set -uo pipefail

HERE=$(dirname "$(realpath "$0")")
PROJECT=$(realpath "$HERE/../..")
. "$HERE/../options.sh"
[ $# -ge 1 ] || { usage >&2; exit 2; }
needs_root_on_debian "window tests of the packages"
PACKAGES=$(realpath -e "$1") || exit 2
OUTPUT=${2:-$PROJECT/build/packages}
shift $(($# < 2 ? $# : 2))
read -ra SUITES <<<"${*:-trixie sid}"
PYTHON=$(realpath -s "${PYTHON:-$PROJECT/.venv/bin/python}")

# Two repositories, with all packages and with the next version of those for Linux; and a package.
prepare_trixie() {
    local newer=$1/newer_zips versions
    versions=$("$PYTHON" "$PROJECT/tests/packages/newer.py" "$newer" "$PACKAGES"/*linux_x64*.zip)
    "$PYTHON" "$PROJECT/scripts/package" repository "$PACKAGES"/*.zip --output "$1/first" &&
        "$PYTHON" "$PROJECT/scripts/package" repository "$newer"/*.zip --output "$1/newer" || return 1
    rm -rf "$newer"
    OPTIONS=(-v "FIRST_VERSION=${versions% *}" -v "NEWER_VERSION=${versions#* }")
    OPTIONS+=(-v "PACKAGE=/share/first/$(basename "$OLDER")" -v EXPECT_DEVICE=taichi-cpu)
}

prepare_sid() {
    cp "$OLDER" "$NEWEST" "$1"
    local name version
    name=$(basename "$NEWEST")
    version=${name#cubic_craft-}
    OPTIONS=(-v "FIRST_VERSION=${version%%-*}" -v "OTHER=/share/$(basename "$OLDER")")
    OPTIONS+=(-v "PACKAGE=/share/$name" -v EXPECT_DEVICE=quadrants-cpu)
}

# -o: the repository is on localhost.
run_suite() {
    local suite=$1 folder=$2
    "$HERE/kit/setup_blender_gui.sh" -s "$suite" && "prepare_$suite" "$folder" || return 1
    local run=("$HERE/kit/run_in_gui.sh" -s "$suite" -g 1400x800 -d "$folder" "${OPTIONS[@]}")
    case $suite in
        trixie) "${run[@]}" -o "$HERE/packages/test_repository.py" &&
            "${run[@]}" "$HERE/packages/test_from_disk.py" ;;
        sid) "${run[@]}" "$HERE/packages/test_refused.py" &&
            "${run[@]}" "$HERE/packages/test_from_disk.py" ;;
    esac
}

NEWEST=$(ls "$PACKAGES"/*linux_x64-python3.14.zip)
OLDER=$(ls "$PACKAGES"/*linux_x64*.zip | grep -vF "$NEWEST" | tail -n 1)  # of 3.13

# Says how it went, and keeps the log.
test_suite() {
    local suite=$1 folder=$OUTPUT/$1 code
    rm -rf "$folder"
    mkdir -p "$folder" || return 1
    run_suite "$suite" "$folder" >"$folder/log.txt" 2>&1
    code=$?
    rm -rf "$folder"/{first,newer,newer_zips} "$folder"/*.zip
    if [ $code = 0 ]; then
        echo "passed: packages on $suite, pictures in $folder"
    else
        cat "$folder/log.txt"
        echo "failed: packages on $suite ($code), pictures in $folder"
        return 1
    fi
}

# Side by side: each has a screen and a folder of its own.
for suite in "${SUITES[@]}"; do test_suite "$suite" & done
RESULT=0
for suite in "${SUITES[@]}"; do wait -n || RESULT=1; done
exit $RESULT
