#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# An array job: each mesh of a folder is a task. Of twenty meshes, with Slurm:
#   sbatch --array=1-20 --cpus-per-task=4 array_job.sh MESHES RESULTS --save-mesh .glb
# Other clusters count their tasks in another variable, such as SGE_TASK_ID or PBS_ARRAY_INDEX.
set -eu
meshes=$1 results=$2 threads=${SLURM_CPUS_PER_TASK:-1}
shift 2
mesh=$meshes/$(ls "$meshes" | sed -n "${SLURM_ARRAY_TASK_ID}p")
export OPENBLAS_NUM_THREADS="$threads" TI_CPU_MAX_NUM_THREADS="$threads"
exec "${BLENDER:-blender}" -b --threads "$threads" --python-exit-code 1 -c cubic_craft "$mesh" \
    --output-folder "$results" --no-render "$@"
