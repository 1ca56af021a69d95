#!/bin/bash
# Random walks through Blender's window, one run for each seed: test_random_walk.py at length.
#   walks.sh EXTENSION.zip [OUTPUT [SUITE...]]        (as for run.sh)
#     SEEDS    numbers of the walks, such as "7" or "1 2 3" (default: 1 2 3 4 5)
#     ACTIONS  steps of each (default: 500; a second each on a machine that has nothing else to do)
# Exit codes: 0 all passed, 1 something failed, 2 wrong options.
set -uo pipefail

HERE=$(dirname "$(realpath "$0")")
if [ $# -lt 1 ]; then
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0" >&2
    exit 2
fi
ZIP=$(realpath -e "$1") || exit 2
OUTPUT=${2:-$HERE/../../build/walks}
shift $(($# < 2 ? $# : 2))
read -ra SUITES <<<"${*:-trixie sid}"
read -ra NUMBERS <<<"${SEEDS:-1 2 3 4 5}"
STEPS=${ACTIONS:-500}
[ -z "${BLENDER:-}" ] || SUITES=(blender)

RESULT=0
for suite in "${SUITES[@]}"; do
    for seed in "${NUMBERS[@]}"; do
        folder=$OUTPUT/$suite/$seed
        mkdir -p "$folder" || exit 2
        options=(-e "$ZIP" -d "$folder" -t $((1800 + 10 * STEPS)))
        options+=(-v "WALK_SEED=$seed" -v "WALK_ACTIONS=$STEPS")
        if [ "$suite" = blender ]; then
            run=("$HERE/kit/run_with_blender.sh")
        else
            "$HERE/kit/setup_blender_gui.sh" -s "$suite" || exit 2
            run=("$HERE/kit/run_in_gui.sh" -s "$suite" -p)
        fi
        if "${run[@]}" "${options[@]}" "$HERE/test_random_walk.py" >"$folder/log.txt" 2>&1; then
            echo "passed: seed $seed, $STEPS actions on $suite, log in $folder"
        else
            tail -n 60 "$folder/log.txt"
            echo "failed: seed $seed on $suite, log in $folder"
            RESULT=1
        fi
    done
done
exit $RESULT
