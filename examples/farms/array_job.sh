#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# An array job: each mesh of a folder is a task. Of twenty meshes, with Slurm:
#   sbatch --array=1-20 --cpus-per-task=4 array_job.sh MESHES RESULTS --save-mesh .glb
# Other clusters count their tasks in another variable, such as SGE_TASK_ID or PBS_ARRAY_INDEX.
set -eu
meshes=$1 results=$2
shift 2
exec "${BLENDER:-blender}" -b --python-exit-code 1 -c cubic_craft "$meshes" \
    --output-folder "$results" --only "$SLURM_ARRAY_TASK_ID" \
    --threads "${SLURM_CPUS_PER_TASK:-1}" --no-render "$@"
