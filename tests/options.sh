# SPDX-License-Identifier: GPL-3.0-or-later
# What scripts that run tests share; to be sourced, with their own arguments. Takes --if-possible
# out of them, and answers --help and what is no first argument.
#   usage        prints the comment at the top of the script
#   skip REASON  says why nothing is run, and exits: with code 0 after --if-possible, else 2
#   needs_root_on_debian WHAT  does so where this is another system, or another user

usage() { sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; }

skip() {
    echo "$1"
    [ -n "$IF_POSSIBLE" ]
    exit $((2 * $?))
}

needs_root_on_debian() {
    { [ "$(id -u)" = 0 ] && grep -qsx 'ID=debian' /etc/os-release; } ||
        skip "$1 skipped: they need root on Debian"
}

IF_POSSIBLE=''
[ "${1:-}" != --if-possible ] || { IF_POSSIBLE=1; shift; }
case ${1:-} in
    -h | --help) usage; exit 0 ;;
    '' | -*) usage >&2; exit 2 ;;
esac
