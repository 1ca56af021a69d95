#!/bin/bash
# Runs every window test (test_*.py of this folder) on a built extension. Of several Blenders, a test
# that says "# Suite: NAME" runs only in that one: what it clicks on is ours, and is drawn as others.
#   run.sh [--if-possible] EXTENSION.zip [OUTPUT [SUITE...]]
#     OUTPUT  folder for screenshots and logs (default: build/gui in the project)
#     SUITE   Debian releases whose Blender is used (default: trixie sid); set up at first use
# With BLENDER set, that Blender is used in place of Debian's; else this needs root on Debian.
# --if-possible: where the tests cannot run, say so and succeed (exit code 0 in place of 2).
# TESTS is a pattern of names, such as "test_live*" (default: all).
# WALK_SEED and WALK_ACTIONS choose another walk of test_random_walk.py (make test-walk).
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

# The backend that must have run: Taichi has no wheel for the Python of sid, Quadrants has.
expected_device() {
    case $1 in
        trixie) echo taichi-cpu ;;
        sid) echo quadrants-cpu ;;
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
            -v "EXPECT_DEVICE=${EXPECT_DEVICE:-$(expected_device "$suite")}" \
            -v "WALK_SEED=${WALK_SEED:-1}" -v "WALK_ACTIONS=${WALK_ACTIONS:-40}" \
            -t $((1800 + 10 * ${WALK_ACTIONS:-0})) "$script"
    fi
}

REASON=$(obstacle)
[ -z "$REASON" ] || skip "window tests skipped: $REASON"
WORK=$(mktemp -d) || exit 2
trap 'rm -rf "$WORK"' EXIT

# Sets up a suite, and installs the extension once for all its tests.
prepare() {
    local suite=$1 folder=$OUTPUT/$1/install only test
    rm -rf "$folder"
    mkdir -p "$folder"
    if { [ "$suite" = blender ] || "$HERE/kit/setup_blender_gui.sh" -s "$suite"; } &&
        run_script "$suite" "$HERE/install.py" "$folder" "$WORK/$suite" -e "$ZIP" >"$folder/log.txt" 2>&1
    then
        # the longest scripts take longest, and would else be waited for in the end
        for test in $(ls -S "$HERE"/${TESTS:-test_*}.py 2>/dev/null); do
            only=$(sed -n 's/^# Suite: //p' "$test")
            if [ "${#SUITES[@]}" = 1 ] || [ "${only:-$suite}" = "$suite" ]; then
                echo "$suite $(basename "$test" .py)"
            fi
        done >"$WORK/$suite.tests"
    else
        cat "$folder/log.txt" 2>/dev/null
        echo "failed: no test on $suite could run" | tee -a "$WORK/failed"
    fi
}

# Runs a test in a copy of the user folder in which the extension was installed.
run_test() {
    local suite=$1 name=$2 test=$HERE/$2.py folder=$OUTPUT/$1/$2 user=$WORK/$1-$2 size code
    rm -rf "$folder"
    mkdir -p "$folder"
    size=$(sed -n 's/^# Window: //p' "$test") # that it needs, if not the usual one
    cp -a "$WORK/$suite" "$user" &&
        run_script "$suite" "$test" "$folder" "$user" ${size:+-g "$size"} >"$folder/log.txt" 2>&1
    code=$?
    rm -rf "$user"
    if [ $code = 0 ]; then
        echo "passed: $name on $suite ($SECONDS s), pictures in $folder"
    else
        cat "$folder/log.txt"
        echo "failed: $name on $suite ($code), pictures in $folder" | tee -a "$WORK/failed"
    fi
}

# Side by side, as many as there are suites: each test has a screen and folders of its own. The
# newest Blender is the slowest, so it comes first.
for suite in "${SUITES[@]}"; do prepare "$suite" & done
wait
export HERE OUTPUT WORK EXPECT_DEVICE
export -f run_test run_script expected_device
if [ -z "$(cat "$WORK"/*.tests 2>/dev/null)" ] && [ ! -e "$WORK/failed" ]; then
    echo "no test's name matches TESTS=${TESTS:-test_*}" >&2
    exit 2
fi
for suite in $(printf '%s\n' "${SUITES[@]}" | tac); do
    [ ! -e "$WORK/$suite.tests" ] || cat "$WORK/$suite.tests"
done | xargs -r -P "${#SUITES[@]}" -L 1 bash -c 'run_test "$@"' run_test
if [ -e "$WORK/failed" ]; then
    cat "$WORK/failed"
    exit 1
fi
echo "all passed"
