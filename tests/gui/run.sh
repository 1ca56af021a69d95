#!/bin/bash
# Runs every window test (test_*.py of this folder) on a built extension.
#   run.sh [--if-possible] EXTENSION.zip [OUTPUT [SUITE...]]
#     OUTPUT  folder for screenshots and logs (default: build/gui in the project)
#     SUITE   Debian releases whose Blender is used (default: trixie sid); set up at first use
# With BLENDER set, that Blender is used in place of Debian's; else this needs root on Debian.
# --if-possible: where the tests cannot run, say so and succeed (exit code 0 in place of 2).
# TESTS is a pattern of names, such as "test_live*" (default: all).
# EXPECT_DEVICE, if set, is the solver backend the tests insist on; Debian's suites have a default.
# Exit codes: 0 all passed, 1 something failed, 2 wrong options or cannot run here.
set -uo pipefail

HERE=$(dirname "$(realpath "$0")")
. "$HERE/../options.sh"
ZIP=$(realpath -e "$1") || exit 2
OUTPUT=${2:-$HERE/../../build/gui}
shift $(($# < 2 ? $# : 2))
read -ra SUITES <<<"${*:-trixie sid}"
if [ -n "${BLENDER:-}" ]; then
    command -v "$BLENDER" >/dev/null || { echo "no such Blender: $BLENDER" >&2; exit 2; }
    SUITES=(blender)
fi
mkdir -p "$OUTPUT" || exit 2
OUTPUT=$(realpath "$OUTPUT")

# Prints why the tests cannot run here; nothing if they can.
obstacle() {
    if [ -n "${BLENDER:-}" ]; then
        [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || command -v Xvfb >/dev/null ||
            echo "BLENDER is set, but there is neither a display nor Xvfb"
    elif ! grep -qsx 'ID=debian' /etc/os-release; then
        echo "not a Debian machine (set BLENDER to a Blender's path to use that one)"
    elif [ "$(id -u)" != 0 ]; then
        echo "they need root (set BLENDER to a Blender's path to use that one)"
    fi
}

# The backend that must have run: Taichi has no wheel for the Python of sid.
expected_device() {
    case $1 in
        trixie) echo taichi-cpu ;;
        sid) echo numpy ;;
    esac
}

# Runs a script with a user folder of its own; further arguments are options.
# It sees all of tests/: some tests make their meshes by tests/art.
run_script() {
    local suite=$1 script=$2 folder=$3 user=$4
    shift 4
    if [ "$suite" = blender ]; then
        "$HERE/kit/run_with_blender.sh" -u "$user" "$@" -d "$folder" "$script"
    else
        "$HERE/kit/run_in_gui.sh" -s "$suite" -p -u "$user" "$@" -d "$folder" -r "$HERE/.." \
            -v "EXPECT_DEVICE=${EXPECT_DEVICE:-$(expected_device "$suite")}" "$script"
    fi
}

# Runs a test in a copy of the user folder in which the extension was installed.
run_test() {
    local suite=$1 test=$2 folder=$3 user=$WORK/$suite-test size
    size=$(sed -n 's/^# Window: //p' "$test") # that it needs, if not the usual one
    rm -rf "$user"
    cp -a "$WORK/$suite" "$user" &&
        run_script "$suite" "$test" "$folder" "$user" ${size:+-g "$size"}
}

REASON=$(obstacle)
[ -z "$REASON" ] || skip "window tests skipped: $REASON"
WORK=$(mktemp -d) || exit 2
trap 'rm -rf "$WORK"' EXIT

# Runs all tests of a suite; fails if one did.
run_suite() {
    local suite=$1 ready=1 failed=0 total=0 test name folder seconds code
    [ "$suite" = blender ] || "$HERE/kit/setup_blender_gui.sh" -s "$suite" || ready=0
    folder=$OUTPUT/$suite/install
    mkdir -p "$folder"
    run_script "$suite" "$HERE/install.py" "$folder" "$WORK/$suite" -e "$ZIP" >"$folder/log.txt" 2>&1 ||
        { ready=0; cat "$folder/log.txt"; }
    for test in "$HERE"/${TESTS:-test_*}.py; do
        name=$(basename "$test" .py)
        folder=$OUTPUT/$suite/$name
        rm -rf "$folder"
        mkdir -p "$folder"
        seconds=$SECONDS
        total=$((total + 1))
        if [ $ready = 0 ]; then
            code="not run, the set-up failed"
        else
            run_test "$suite" "$test" "$folder" >"$folder/log.txt" 2>&1
            code=$?
        fi
        if [ "$code" = 0 ]; then
            echo "passed: $name on $suite ($((SECONDS - seconds)) s), pictures in $folder"
        else
            failed=$((failed + 1))
            [ ! -e "$folder/log.txt" ] || cat "$folder/log.txt"
            echo "failed: $name on $suite ($code), pictures in $folder"
        fi
    done
    echo "$suite: $((total - failed)) passed, $failed failed"
    [ $failed = 0 ]
}

# Side by side: each has a screen, a chroot and a folder of its own.
JOBS=()
for suite in "${SUITES[@]}"; do
    run_suite "$suite" &
    JOBS+=($!)
done
RESULT=0
for job in "${JOBS[@]}"; do wait "$job" || RESULT=1; done
exit $RESULT
