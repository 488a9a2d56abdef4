#!/bin/bash
# scripts/slurm with a Slurm cluster of one node: tasks fail and are cancelled, the same command computes the rest, and the
# result equals that of one run. usage: slurm_test.sh BRISTLE, from the repository's root. Exit code 77 (skipped) if a
# cluster cannot be started.
set -u
bristle=$1
# shellcheck source=tests/program/slurm_cluster.sh
. "$(dirname "$0")/slurm_cluster.sh"

obstacle=$(cluster_obstacle)
if [ -n "$obstacle" ]; then
  echo "skipped: $obstacle"
  exit 77
fi
folder=$(mktemp -d)
clean_up() {
  stop_cluster || failures=$((failures + 1))
  rm -rf "$folder"
  exit $((failures > 0))
}
failures=0
trap clean_up EXIT
trap 'exit 1' INT TERM HUP
fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

if ! start_cluster; then
  tail -n 5 "$cluster"/*.log
  if [ "$(id -u)" != 0 ]; then
    stop_cluster
    rm -rf "$folder"
    trap - EXIT
    echo "skipped: Slurm's daemons do not start without root's rights here"
    exit 77
  fi
  fail "the cluster does not start"
  exit
fi

# Sixteen points, about a second each.
options=(--set '/sweep/k_r={"values":[2,5,10,20],"logspace":null}' --set '/sweep/k_theta={"values":[0.3,3],"logspace":null}'
  --set '/load={"R_n":null,"path":null,"z_0":0.5}' --set /checks=null --set /locate_jumps=null
  --set /integrator/engine=reference --set '/orientation={"rtol":0.003}')
whole=$folder/whole/fig4.h5 result=$folder/shards/fig4.h5
submit() { BRISTLE=$bristle scripts/slurm/array.sh -o "$result" experiments/fig4.json "3%3" --cpus-per-task=1 -- "${options[@]}"; }
digest() { "$bristle" info "$1" | grep -o '^payload sha256 [0-9a-f]*'; }
holds() { grep -qF -- "$2" "$1" || { fail "$1 does not contain: $2; it contains:"; cat "$1"; }; }

# Mistakes are reported before a job is submitted.
for mistake in "experiments/fig4.json 0" "experiments/fig4.json three" "nowhere.json 3" "experiments/fig4.json 3 -- --tier medium" \
  "experiments/fig4.json 3 -- --treads 2" "experiments/fig4.json 3 -- --force"; do
  # shellcheck disable=SC2086 # words
  BRISTLE=$bristle scripts/slurm/array.sh $mistake >"$folder/log" 2>&1
  [ $? = 2 ] || { fail "exit code after: array.sh $mistake"; cat "$folder/log"; }
done
no_jobs || fail "a mistake was submitted"

# Of three tasks, one is cancelled while it computes and one cannot write its journal.
mkdir -p "$result.3-of-3.journal"
submit >"$folder/log" 2>&1 || { fail "submission"; cat "$folder/log"; exit; }
tasks=$(sed -n 's/^job \([0-9]*\): 3 shards.*/\1/p' "$folder/log")
last=$(sed -n 's/^job \([0-9]*\): completes.*/\1/p' "$folder/log")
within 120 test -s "$result.2-of-3.journal" || fail "the second task finishes no point"
scancel "${tasks}_2"
within 240 no_jobs || { fail "jobs do not end"; squeue; }
holds "$folder/shards/fig4.1-of-3.log" "15 of 24 points of fig4 are not yet in the journals"
holds "$folder/shards/fig4.2-of-3.log" "interrupted"
holds "$folder/shards/fig4.3-of-3.log" "is a folder"
scontrol show job "$last" | grep -q 'JobState=CANCELLED' || fail "the last job was not cancelled"
[ ! -e "$result" ] || fail "there is a result although points are missing"
"$bristle" run experiments/fig4.json "${options[@]}" --complete -o "$result" >"$folder/log" 2>&1
[ $? = 2 ] || fail "exit code of a completion without all shards"
holds "$folder/log" "of 24 points are missing"
holds "$folder/log" "--shard 2/3"

# The same command computes what the tasks left: nothing, some points, all points.
rmdir "$result.3-of-3.journal"
submit >"$folder/log" 2>&1 || { fail "second submission"; cat "$folder/log"; exit; }
"$bristle" run experiments/fig4.json "${options[@]}" -o "$whole" --quiet || fail "the run of the whole"
within 240 no_jobs || { fail "jobs do not end"; squeue; }
holds "$folder/shards/fig4.1-of-3.log" "8 computed before"
holds "$folder/shards/fig4.2-of-3.log" "computed before"
[ -f "$result" ] || { fail "no result"; cat "$folder"/shards/*.log; exit; }
[ "$(digest "$result")" = "$(digest "$whole")" ] || fail "the numbers are not those of one run"
"$bristle" diff "$result" "$whole" || fail "the result differs from that of one run"
[ -z "$(ls "$result".*-of-3.journal 2>/dev/null)" ] || fail "journals of the shards are left"
