#!/bin/bash
# Sets up Debian's Blenders for the window tests, side by side, as run.sh does at first use.
#   set_up.sh [--if-possible] SUITE...
#     SUITE  Debian releases: trixie, sid
# --if-possible: where they cannot run, say so and succeed.
# Exit codes: 0 all are set up, 1 one could not be, 2 wrong options or cannot run here.
set -uo pipefail

HERE=$(dirname "$(realpath "$0")")
. "$HERE/../options.sh"
needs_root_on_debian "window tests"
printf '%s\n' "$@" | xargs -P "$#" -L 1 "$HERE/kit/setup_blender_gui.sh" -s || exit 1
