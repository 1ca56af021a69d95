#!/bin/bash
# Runs a guidrive test in a GUI Blender without a screen, in the chroot of setup_blender_gui.sh.
#   run_in_gui.sh [options] SCRIPT.py [ARGS...]      (ARGS are in sys.argv, after "--")
#     -s SUITE  trixie (default) or sid
#     -e EXT    install and enable this extension first: a zip, or a source folder (built first);
#               may be given several times
#     -p        let Blender import the packages of /opt/pysite (BLENDER_GUI_WHEELS of the set-up)
#     -d DIR    folder shown as /share, read-write, for screenshots and other results
#               (default: BLENDER_GUI_ROOT/share/SUITE)
#     -r DIR    folder shown as /test, read-only; SCRIPT must lie in it (default: SCRIPT's folder)
#     -u DIR    keep Blender's user folder (preferences, extensions) in DIR (default: a new one)
#     -g, -t, -v  as for run_with_blender.sh, which runs in the chroot
# Needs root. Exit codes: 0 passed, 1 failed; the others are listed in ../README.md.
set -euo pipefail

usage() { sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; }
die() {
    echo "run_in_gui: $*" >&2
    exit 2
}

# Runs in the new namespaces, still on the host's files: mounts the parts and enters the chroot.
enter() {
    trap 'echo "run_in_gui: mounting failed" >&2; exit 95' ERR
    mount -o bind,ro "$CHROOT" "$CHROOT"
    cd "$CHROOT"
    mount -t proc proc proc
    mount --rbind /sys sys
    mount --rbind /dev dev
    mount -t tmpfs -o mode=1777 tmpfs dev/shm
    mount -t tmpfs -o mode=1777 tmpfs tmp
    mount --bind "$SHADERS" var/cache/gui
    mount -o bind,ro "$KIT" opt/guidrive
    mount -o bind,ro "$TESTS" test
    mount --bind "$SHARE" share
    if [ -n "$PYSITE" ]; then
        mount -o bind,ro opt/pysite "usr/local/lib/python$PYTHON/dist-packages"
    fi
    mkdir -m 700 tmp/xdg
    # Compiled shaders are kept (Blender starts in 2 s in place of 6); all other caches are new.
    mkdir -p tmp/home/.cache tmp/user tmp/ext var/cache/gui/blender
    ln -s /var/cache/gui/blender tmp/home/.cache/blender
    if [ -n "$USER_DIR" ]; then
        mount --bind "$USER_DIR" tmp/user
    fi
    local number extension chroot
    for number in "${!EXTENSIONS[@]}"; do
        extension=tmp/ext/$number/$(basename "${EXTENSIONS[number]}")
        if [ -d "${EXTENSIONS[number]}" ]; then
            mkdir -p "$extension"
            mount -o bind,ro "${EXTENSIONS[number]}" "$extension"
        else
            mkdir "tmp/ext/$number"
            cp "${EXTENSIONS[number]}" "$extension"
        fi
        OPTIONS+=(-e "/$extension")
    done
    chroot=$(command -v chroot)
    exec env -i PATH=/usr/local/bin:/usr/bin:/bin LC_ALL=C.UTF-8 HOME=/tmp/home \
        XDG_RUNTIME_DIR=/tmp/xdg MESA_SHADER_CACHE_DIR=/var/cache/gui \
        GUIDRIVE_PLACES=/var/cache/gui/places.json \
        "$chroot" . bash /opt/guidrive/run_with_blender.sh -d /share -u /tmp/user \
        "${OPTIONS[@]}" "$SCRIPT" "$@"
}

SUITE=trixie PYSITE='' SHARE='' TESTS='' USER_DIR='' EXTENSIONS=() OPTIONS=()
while getopts s:e:pd:r:u:g:t:v:h option; do
    case $option in
        s) SUITE=$OPTARG ;;
        e) EXTENSIONS+=("$(realpath -e "$OPTARG")") || exit 2 ;;
        p) PYSITE=1 ;;
        d) SHARE=$OPTARG ;;
        r) TESTS=$OPTARG ;;
        u) USER_DIR=$OPTARG ;;
        g | t | v) OPTIONS+=("-$option" "$OPTARG") ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -ge 1 ] || { usage >&2; exit 2; }
[ "$(id -u)" = 0 ] || die "needs root"

ROOT=${BLENDER_GUI_ROOT:-${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/blender-gui}
[ -e "$ROOT/chroot/$SUITE" ] || die "not set up; run: setup_blender_gui.sh -s $SUITE"
ROOT=$(realpath "$ROOT")
CHROOT=$ROOT/chroot/$SUITE
SHADERS=$ROOT/shaders/$SUITE
KIT=$(dirname "$(realpath "$0")")
SCRIPT=$(realpath -e "$1") || exit 2
shift
TESTS=$(realpath -e "${TESTS:-$(dirname "$SCRIPT")}") || exit 2
[[ $SCRIPT == "$TESTS"/* ]] || die "$SCRIPT does not lie in $TESTS"
SCRIPT=/test/${SCRIPT#"$TESTS"/}
SHARE=${SHARE:-$ROOT/share/$SUITE}
mkdir -p "$SHARE" ${USER_DIR:+"$USER_DIR"}
SHARE=$(realpath "$SHARE")
USER_DIR=${USER_DIR:+$(realpath "$USER_DIR")}

exec 9>>"$ROOT/$SUITE.lock"
flock -s 9  # waits for a set-up; many runs may share it
[ -e "$CHROOT/.blender_gui_ready" ] || die "not set up; run: setup_blender_gui.sh -s $SUITE"
VERSIONS=$(cat "$CHROOT/.blender_gui_ready")
PYTHON=${VERSIONS##*Python }
echo "run_in_gui: $VERSIONS; /share is $SHARE"
SETTINGS=$(declare -p CHROOT SHADERS KIT TESTS SHARE USER_DIR PYSITE PYTHON EXTENSIONS OPTIONS \
    SCRIPT && declare -f enter)
export SETTINGS
# Namespaces of its own: the mounts and processes end with the run, and it ends with this script.
trap 'exit 130' INT
setpriv --pdeathsig KILL unshare --mount --mount-proc --pid --ipc --net \
    --fork --kill-child bash -euc "$SETTINGS; enter \"\$@\"" enter "$@" &
wait $!
