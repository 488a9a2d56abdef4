#!/bin/bash
# Computes an experiment as a Slurm job array and completes the result; see docs/running.md. Called again after a failure,
# it computes only what is missing.
set -eu

usage() {
  cat >&2 <<'EOF'
usage: array.sh [-o FILE.h5] EXPERIMENT.json N[%M] [SBATCH OPTIONS ...] [-- RUN OPTIONS ...]

  -o FILE.h5       the result [results/EXPERIMENT.h5]; the journals of the shards and the jobs' logs lie beside it
  N[%M]            number of shards, each a task of the array; at most M run at a time
  SBATCH OPTIONS   for all tasks: --cpus-per-task=8 --time=2:00:00 --partition=... --account=...
  RUN OPTIONS      for all jobs, of `bristle run`: --tier smoke --set /model/k_r=20
BRISTLE names the program [by default the one of this source tree, or the installed one].
EOF
  exit 2
}

die() {
  echo "array.sh: $1" >&2
  exit 2
}

output=
while [ $# -gt 0 ]; do
  case $1 in
    -o) [ $# -ge 2 ] || usage; output=$2; shift 2 ;;
    -o*) output=${1#-o}; shift ;;
    -*) usage ;;
    *) break ;;
  esac
done
[ $# -ge 2 ] || usage
experiment=$1 array=$2
shift 2
[[ $array =~ ^([1-9][0-9]*)(%[1-9][0-9]*)?$ ]] || die "N is \"$array\"; it is a number of shards from 1, or N%M for at most M at a time"
shards=${BASH_REMATCH[1]}
[ -f "$experiment" ] || die "$experiment: no such file"

sbatch_options=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  sbatch_options+=("$1")
  shift
done
[ $# -eq 0 ] || shift
run_options=("$@")

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$here/../../build/bristle
[ -x "$program" ] || program=$here/../../../bin/bristle  # installed: this file is in share/bristle/slurm
program=${BRISTLE:-$(realpath -m "$program")}
command -v "$program" >/dev/null || die "$program: no such program; \`make build\` makes it, BRISTLE=... names another"
command -v sbatch >/dev/null || die "sbatch: not found; this needs a machine that submits to Slurm (docs/running.md has other ways)"

name=$(basename "$experiment" .json)
output=${output:-results/$name.h5}
stem=${output%.h5}
mkdir -p "$(dirname "$output")"
# Report a mistake here rather than in N tasks.
options=()
for ((i = 0; i < ${#run_options[@]}; ++i)); do
  case ${run_options[i]} in
    --set | --tier) options+=("${run_options[i]}" "${run_options[i + 1]-}"); i=$((i + 1)) ;;
    --set=* | --tier=*) options+=("${run_options[i]}") ;;
  esac
done
"$program" validate "$experiment" "${options[@]}"
known=$("$program" run --help)
for option in "${run_options[@]}"; do
  word=${option%%=*}
  [[ $word != --force ]] || die "--force: shards would compute all points each time; remove the journals beside $output instead"
  [[ $word != --* || $known == *"$word"* ]] || die "$word: \`bristle run\` has no such option"
done

log=${stem//%/%%}  # sbatch replaces %a
tasks=$(sbatch --parsable --job-name="$name" --output="$log.%a-of-$shards.log" "${sbatch_options[@]}" \
  --array="1-$array" "$here/shard.sbatch" "$program" "$experiment" "$output" "$shards" "${run_options[@]}")
tasks=${tasks%%;*}  # "job;cluster" where there are several clusters
complete=$(sbatch --parsable --job-name="$name-complete" --output="$log.complete.log" "${sbatch_options[@]}" \
  --dependency="afterok:$tasks" --kill-on-invalid-dep=yes "$here/complete.sbatch" "$program" "$experiment" "$output" \
  "${run_options[@]}")
cat <<EOF
job $tasks: $shards shards, logs $stem.*-of-$shards.log
job ${complete%%;*}: completes $output once all are done, log $stem.complete.log
\`squeue --me\` shows both. If a task fails, the same command again computes what is missing.
EOF
