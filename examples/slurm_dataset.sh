#!/bin/sh
# A data set by a job array of Slurm: 8 jobs, each with all blocks of one shard. The last one to end joins the parts.
#   sbatch examples/slurm_dataset.sh examples/dataset_town.yaml /shared/town_chips
# A job that was cut off: submit the same array again; what is whole is not made again.
# Both paths lie on a shared file system.
#SBATCH --job-name=yars-dataset
#SBATCH --array=0-7
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=16
#SBATCH --mem-per-cpu=600M
#SBATCH --time=04:00:00
#SBATCH --signal=TERM@30
set -eu
# exec: the signal of --signal reaches the data set maker itself, which ends its workers and leaves a folder to go on
# with.
exec python3 -m yars.dataset "$1" --out "$2" --workers "${SLURM_CPUS_PER_TASK:-1}" \
  --shard "${SLURM_ARRAY_TASK_ID:-0}/${SLURM_ARRAY_TASK_COUNT:-1}"
