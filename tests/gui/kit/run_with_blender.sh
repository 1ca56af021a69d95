#!/bin/bash
# Runs a guidrive test in the window of an installed Blender (Linux, Blender 4.2 or newer).
#   run_with_blender.sh [options] SCRIPT.py [ARGS...]    (ARGS are in sys.argv, after "--")
#     -e EXT    install and enable this extension first: a zip, or a source folder (built first);
#               may be given several times
#     -d DIR    folder for screenshots and other results (default: the current folder)
#     -u DIR    keep Blender's user folder (preferences, extensions) in DIR (default: a new one,
#               so your own preferences and extensions are neither used nor changed)
#     -g WxH    size of Blender's window (default 1000x700)
#     -t SECS   time limit for Blender (default 1800)
#     -v A=B    set this environment variable for Blender; may be given several times
# Environment: BLENDER is the executable (default: blender). Where neither DISPLAY nor
# WAYLAND_DISPLAY is set, the window opens in an X server without a screen (Xvfb;
# needs ImageMagick and xdotool, too, for screenshots).
# Exit codes: 0 passed, 1 failed; the others are listed in ../README.md.
set -uo pipefail

usage() { sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; }
say() { echo "guidrive: $*"; }
die() {
    echo "guidrive: $*" >&2
    exit 2
}

SHARE=. USER_DIR='' SIZE=1000x700 LIMIT=1800 EXTENSIONS=()
while getopts e:d:u:g:t:v:h option; do
    case $option in
        e) EXTENSIONS+=("$OPTARG") ;;
        d) SHARE=$OPTARG ;;
        u) USER_DIR=$OPTARG ;;
        g) SIZE=$OPTARG ;;
        t) LIMIT=$OPTARG ;;
        v) [[ $OPTARG == [A-Za-z_]*=* ]] || die "-v $OPTARG: not NAME=VALUE"
           export "${OPTARG?}" ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -ge 1 ] || { usage >&2; exit 2; }
[[ $SIZE =~ ^[0-9]+x[0-9]+$ ]] || die "-g $SIZE: not WIDTHxHEIGHT"
BLENDER=$(command -v "${BLENDER:-blender}") || die "no such Blender: ${BLENDER:-blender}"
BLENDER=$(realpath -s "$BLENDER")
KIT=$(dirname "$(realpath "$0")")
SCRIPT=$(realpath -e "$1") || exit 2
shift

WORK=$(mktemp -d) || exit 2
XVFB=''
clean_up() {
    [ -z "$XVFB" ] || kill "$XVFB" 2>/dev/null
    rm -rf "$WORK"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

mkdir -p "$SHARE" "${USER_DIR:=$WORK/user}" "$WORK/tmp" || exit 2
BLENDER_USER_RESOURCES=$(realpath "$USER_DIR")
GUIDRIVE_SHARE=$(realpath "$SHARE")
GUIDRIVE_PASSED=$WORK/passed  # guidrive makes this file when the test has passed
export BLENDER_USER_RESOURCES GUIDRIVE_SHARE GUIDRIVE_PASSED

install_extension() {
    local zip=$1
    say "installing $1"
    if [ -d "$1" ]; then
        zip=$WORK/extension.zip
        rm -f "$zip"
        "$BLENDER" --command extension build --source-dir "$1" --output-filepath "$zip" || exit 96
    fi
    "$BLENDER" --command extension install-file -r user_default -e "$zip" || exit 96
}

# Starts an X server without a screen, with software OpenGL. No key repeats (-r): on a slow machine
# a key that a test presses for a moment would count twice.
start_xvfb() {
    command -v Xvfb >/dev/null || die "no display: set DISPLAY, or install Xvfb"
    command -v import >/dev/null && command -v xdotool >/dev/null ||
        die "screenshots in Xvfb need ImageMagick (import) and xdotool"
    Xvfb -displayfd 3 -screen 0 "${SIZE}x24" +extension GLX -nolisten tcp -noreset -r \
        3>"$WORK/display" >"$WORK/xvfb.log" 2>&1 &
    XVFB=$!
    local display='' turn
    for ((turn = 0; turn < 400; turn++)); do
        display=$(cat "$WORK/display")
        [ -z "$display" ] || break
        sleep 0.05
    done
    [ -n "$display" ] || { cat "$WORK/xvfb.log"; exit 98; }
    unset WAYLAND_DISPLAY
    export DISPLAY=:$display LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe
}

for extension in "${EXTENSIONS[@]}"; do
    install_extension "$extension"
done
[ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || start_xvfb

IMPORT_PATH='import os, sys
script = sys.argv[sys.argv.index("--python") + 1]
sys.path[:0] = [os.path.dirname(script), os.environ["GUIDRIVE_KIT"]]'
GUIDRIVE_KIT=$KIT TMPDIR=$WORK/tmp timeout --foreground -k 10 "$LIMIT" "$BLENDER" --enable-event-simulate \
    -noaudio --offline-mode --window-geometry 0 0 "${SIZE%x*}" "${SIZE#*x}" \
    --python-exit-code 97 --python-expr "$IMPORT_PATH" --python "$SCRIPT" -- "$@" 2>&1
code=$?
if [ $code -ge 128 ]; then
    grep -hv "frozen importlib" "$WORK"/tmp/*.crash.txt 2>/dev/null
elif [ $code = 0 ] && [ ! -e "$GUIDRIVE_PASSED" ]; then
    say "Blender ended before the test did"
    code=94
fi
exit $code
