#!/bin/bash
# Sets up a GUI Blender in a Debian chroot: Blender, an X server without a screen, software OpenGL.
#   setup_blender_gui.sh [-s SUITE]     SUITE: trixie (default; Blender 4.3, Python 3.13)
#                                              sid    (Blender 5.2 LTS or newer, Python 3.14)
# Needs root on a Debian machine (apt, for the mirror and for debootstrap) and pip (for the wheels).
# Run it again at will: it skips what is done, and starts over what was interrupted.
# Environment:
#   BLENDER_GUI_ROOT    folder for all it makes (default: ${XDG_CACHE_HOME:-~/.cache}/blender-gui)
#   BLENDER_GUI_WHEELS  packages to put on /opt/pysite (default: "taichi==1.7.4 scipy cholespy", on
#                       sid Quadrants in place of Taichi; "": none); what has no wheel for the suite's
#                       Python is reported and left out
#   BLENDER_GUI_MIRROR  Debian mirror (default: the one in this machine's apt configuration)
set -euo pipefail

ROOT=${BLENDER_GUI_ROOT:-${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/blender-gui}
PACKAGES=(blender xvfb libgl1 libgl1-mesa-dri libglx-mesa0 libegl1 libegl-mesa0 xdotool imagemagick
    python3-pip python3-numpy python3-requests)
CHROOT_PATH=/usr/sbin:/usr/bin:/sbin:/bin

usage() { sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; }
say() { echo "[setup $SUITE ${SECONDS}s] $*"; }
die() {
    echo "setup_blender_gui: $*" >&2
    exit 1
}
die_with_log() {
    tail -n 20 "$1" >&2
    die "$2"
}

SUITE=trixie
while getopts s:h option; do
    case $option in
        s) SUITE=$OPTARG ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
[ $# -lt $OPTIND ] || { usage >&2; exit 2; }
case $SUITE in
    trixie) ENGINE=taichi==1.7.4 ;;
    sid)
        ENGINE=quadrants==1.4.0
        PACKAGES+=(python3-cattr)  # Blender 5 needs it; Debian's package lacks the dependency
        ;;
    *) echo "unknown suite $SUITE (trixie or sid)" >&2; exit 2 ;;
esac
WHEELS=${BLENDER_GUI_WHEELS-$ENGINE scipy cholespy}
[ "$(id -u)" = 0 ] || die "needs root"

mkdir -p "$ROOT/chroot" "$ROOT/log" "$ROOT/wheels" "$ROOT/shaders/$SUITE"
ROOT=$(realpath "$ROOT")
CHROOT=$ROOT/chroot/$SUITE
READY=$CHROOT/.blender_gui_ready     # written last; holds the versions
WHEELS_DONE=$CHROOT/opt/pysite.done  # 1st line: the packages asked for; 2nd: those not available

# Runs a bash script in namespaces of its own: its mounts and its processes end with it,
# and it ends with this script, however that ends.
isolated() {
    setpriv --pdeathsig KILL unshare --mount --mount-proc --pid --ipc --fork --kill-child \
        bash -euc "$@" &
    wait $!
}
trap 'exit 130' INT

is_done() {
    [ -e "$READY" ] && [ -e "$WHEELS_DONE" ] && [ "$(head -n 1 "$WHEELS_DONE")" = "$WHEELS" ]
}

report() {
    local missing
    missing=$(sed -n 2p "$WHEELS_DONE")
    say "ready: $(cat "$READY"); wheels: ${WHEELS:-none}${missing:+; NOT AVAILABLE: $missing}"
}

host_apt() { flock "$ROOT/apt.lock" apt-get -qq -o DPkg::Lock::Timeout=300 "$@" >/dev/null; }

host_install() {
    say "installing $1 on this machine"
    host_apt update
    host_apt -y install --no-install-recommends "$1"
}

debian_mirror() {
    apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' 'Created-By: Packages' |
        awk '$1 == "Debian" && $2 == "Debian" && !found++ { print $3 }'
}

bootstrap_debian() {
    local mirror=${BLENDER_GUI_MIRROR:-$(debian_mirror)} log=$ROOT/log/debootstrap_$SUITE.log
    if [ -z "$mirror" ]; then  # apt has no package lists yet
        host_apt update
        mirror=$(debian_mirror)
    fi
    [ -n "$mirror" ] || die "no Debian mirror in apt's configuration; set BLENDER_GUI_MIRROR"
    command -v debootstrap >/dev/null || host_install debootstrap
    local keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    [ -e $keyring ] || host_install debian-archive-keyring

    say "bootstrapping Debian"
    rm -rf --one-file-system "$CHROOT"
    mkdir -p "$CHROOT"
    isolated 'debootstrap --variant=minbase --keyring="$1" --include=ca-certificates "${@:2}"' _ \
        $keyring "$SUITE" "$CHROOT" "$mirror" >"$log" 2>&1 ||
        die_with_log "$log" "debootstrap failed"

    printf '#!/bin/sh\nexit 101\n' >"$CHROOT/usr/sbin/policy-rc.d"  # start no daemons
    chmod +x "$CHROOT/usr/sbin/policy-rc.d"
    {
        echo 'APT::Install-Recommends "false"; Acquire::Languages "none";'
        apt-config dump | grep -E '^Acquire::(http|https|Check-)' || true
    } >"$CHROOT/etc/apt/apt.conf.d/99local"
    cp -L /etc/resolv.conf "$CHROOT/etc/resolv.conf"
    ln -sf /proc/self/mounts "$CHROOT/etc/mtab"
    # run_in_gui.sh mounts its folders on these:
    mkdir -p "$CHROOT"/{share,test,opt/guidrive,opt/pysite,var/cache/gui}
}

install_blender() {
    local log=$ROOT/log/install_$SUITE.log
    say "installing Blender"
    isolated '
        cd "$1"
        mount -t proc proc proc
        mount --rbind /dev dev
        mount --rbind /sys sys
        export DEBIAN_FRONTEND=noninteractive LC_ALL=C PATH='$CHROOT_PATH'
        chroot . apt-get -qq update
        chroot . apt-get -y -qq install --no-install-recommends "${@:2}"
        chroot . apt-get clean' _ "$CHROOT" "${PACKAGES[@]}" >"$log" 2>&1 ||
        die_with_log "$log" "installing Blender failed"
}

# Starts Blender once, which shows that it works and which Python it has.
note_versions() {
    local expression='import bpy, sys; print("VERSIONS Blender", bpy.app.version_string + ",",
        "Python", "%d.%d" % sys.version_info[:2])' versions
    versions=$(isolated '
        cd "$1"
        mount -t proc proc proc
        mount -t tmpfs tmpfs tmp
        export HOME=/tmp PATH='$CHROOT_PATH'
        chroot . blender --background --factory-startup -noaudio --python-expr "$2"' \
        _ "$CHROOT" "$expression" 2>>"$ROOT/log/install_$SUITE.log" | sed -n 's/^VERSIONS //p')
    [[ $versions =~ Python\ (.*) ]] || die "Blender does not start; see $ROOT/log"
    mkdir -p "$CHROOT/usr/local/lib/python${BASH_REMATCH[1]}/dist-packages"
    echo "$versions" >"$READY"
}

make_chroot() {
    bootstrap_debian
    install_blender
    note_versions
}

# Downloads with this machine's pip, which knows the index and its certificates.
# Sets AVAILABLE and MISSING from the packages asked for.
download_wheels() {
    local folder=$1 python=$2 log=$3 package packages
    python3 -m pip --version >/dev/null 2>&1 || host_install python3-pip
    local download=(python3 -m pip download -q --disable-pip-version-check
        --cache-dir "$ROOT/pip-cache" --only-binary=:all: --python-version "$python" -d "$folder")
    read -ra packages <<<"$WHEELS"
    AVAILABLE=() MISSING=()
    for package in "${packages[@]}"; do
        say "wheel for Python $python: $package"
        if "${download[@]}" --no-deps "$package" >"$log" 2>&1; then
            AVAILABLE+=("$package")
        elif grep -qE 'Retrying|Could not fetch' "$log"; then  # a failure, not an answer
            die_with_log "$log" "downloading $package failed"
        else
            MISSING+=("$package")
            say "NOT AVAILABLE for Python $python: $package"
        fi
    done
    [ ${#AVAILABLE[@]} = 0 ] || "${download[@]}" "${AVAILABLE[@]}" >"$log" 2>&1 ||
        die_with_log "$log" "downloading the wheels failed"
}

install_wheels() {
    local python folder log=$ROOT/log/wheels_$SUITE.log
    python=$(sed 's/.*Python //' "$READY")
    folder=$ROOT/wheels/$python
    mkdir -p "$folder"
    download_wheels "$folder" "$python" "$log"
    rm -rf "$CHROOT/opt/pysite" "$WHEELS_DONE"
    mkdir "$CHROOT/opt/pysite"
    if [ ${#AVAILABLE[@]} -gt 0 ]; then
        isolated '
            mount --bind "$2" "$1/mnt"
            env -i PATH='$CHROOT_PATH' HOME=/root "$(command -v chroot)" "$1" \
                "python$3" -m pip install -q --root-user-action ignore --no-index --no-cache-dir \
                --find-links /mnt --target /opt/pysite "${@:4}"' \
            _ "$CHROOT" "$folder" "$python" "${AVAILABLE[@]}" >>"$log" 2>&1 ||
            die_with_log "$log" "installing the wheels failed"
        rm -rf "$CHROOT"/opt/pysite/numpy{,.libs,-*}  # Blender has Debian's numpy loaded
    fi
    printf '%s\n' "$WHEELS" "${MISSING[*]}" >"$WHEELS_DONE"
}

if ! is_done; then
    exec 9>>"$ROOT/$SUITE.lock"
    if ! flock -n 9; then  # held by another set-up, or by runs
        say "waiting for another set-up or for runs to end"
        flock 9
    fi
    [ -e "$READY" ] || make_chroot
    is_done || install_wheels
fi
report
