#!/bin/bash
# scripts/slurm with a Slurm cluster of one node: tasks fail and are cancelled, the same command computes the rest, and the
# merge equals the whole result. usage: slurm_test.sh BRISTLE, from the repository's root. Exit code 77 (skipped) if a
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

# Eight points, about a second each.
options=(--set '/sweep/k_r={"values":[2,5,10,20],"logspace":null}' --set '/sweep/k_theta={"values":[0.3,3],"logspace":null}'
  --set /checks=null
  --set /integrator/engine=reference --set '/orientation={"rtol":0.1}')
whole=$folder/whole/fig4.h5 merged=$folder/parts/fig4.h5
submit() { BRISTLE=$bristle scripts/slurm/array.sh -o "$merged" experiments/fig4.json "3%3" --cpus-per-task=1 -- "${options[@]}"; }
digest() { "$bristle" info "$1" | grep -o '^payload sha256 [0-9a-f]*'; }
holds() { grep -qF -- "$2" "$1" || { fail "$1 does not contain: $2; it contains:"; cat "$1"; }; }

# Mistakes are reported before a job is submitted.
for mistake in "experiments/fig4.json 0" "experiments/fig4.json three" "nowhere.json 3" "experiments/fig4.json 3 -- --tier medium"; do
  # shellcheck disable=SC2086 # words
  BRISTLE=$bristle scripts/slurm/array.sh $mistake >"$folder/log" 2>&1
  [ $? = 2 ] || { fail "exit code after: array.sh $mistake"; cat "$folder/log"; }
done
no_jobs || fail "a mistake was submitted"

# Of three tasks, one is cancelled while it computes and one cannot write its output.
mkdir -p "$folder/parts/fig4.3-of-3.h5"
submit >"$folder/log" 2>&1 || { fail "submission"; cat "$folder/log"; exit; }
tasks=$(sed -n 's/^job \([0-9]*\): 3 shards.*/\1/p' "$folder/log")
merge=$(sed -n 's/^job \([0-9]*\): merges.*/\1/p' "$folder/log")
within 120 test -s "$folder/parts/fig4.2-of-3.h5.journal" || fail "the second task finishes no point"
scancel "${tasks}_2"
within 240 no_jobs || { fail "jobs do not end"; squeue; }
[ -f "$folder/parts/fig4.1-of-3.h5" ] || fail "the first task made no part"
holds "$folder/parts/fig4.2-of-3.log" "interrupted"
holds "$folder/parts/fig4.3-of-3.log" "is a folder"
scontrol show job "$merge" | grep -q 'JobState=CANCELLED' || fail "the merge was not cancelled"
[ ! -e "$merged" ] || fail "there is a result although parts are missing"
"$bristle" merge -o "$merged" "$folder"/parts/fig4.1-of-3.h5 >"$folder/log" 2>&1
[ $? = 2 ] || fail "exit code of a merge without all parts"
holds "$folder/log" "10 of 16 points are missing: 1 (azimuth_rate = kinematic, k_r = 2, k_theta = 3)"
holds "$folder/log" "--shard 2/3"

# The same command computes what the tasks left: nothing, some points, all points.
rmdir "$folder/parts/fig4.3-of-3.h5"
before=$(stat -c %Y.%i "$folder/parts/fig4.1-of-3.h5")
submit >"$folder/log" 2>&1 || { fail "second submission"; cat "$folder/log"; exit; }
"$bristle" run experiments/fig4.json "${options[@]}" -o "$whole" --quiet || fail "the run of the whole"
within 240 no_jobs || { fail "jobs do not end"; squeue; }
[ "$before" = "$(stat -c %Y.%i "$folder/parts/fig4.1-of-3.h5")" ] || fail "a finished part was written again"
holds "$folder/parts/fig4.1-of-3.log" "is up to date"
holds "$folder/parts/fig4.2-of-3.log" "computed before"
[ -f "$merged" ] || { fail "no result"; cat "$folder"/parts/*.log; exit; }
[ "$(digest "$merged")" = "$(digest "$whole")" ] || fail "the merge's numbers are not those of the whole"
"$bristle" diff "$merged" "$whole" || fail "the merge differs from the whole"
