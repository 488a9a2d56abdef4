#!/bin/bash
# An experiment gives the same bits with different numbers of threads, with all instruction sets of this machine, and
# when completed from shards. usage: ways_test.sh BRISTLE EXPERIMENT RESULT
set -u
bristle=$1 experiment=$2 result=$3
. "$(dirname "$0")/shell.sh"
expected=$(digest "$result")
[ -n "$expected" ] || { echo "FAILED: $result has no digest that verifies"; exit 1; }
run() { "$bristle" run "$experiment" --tier smoke --force --quiet "$@"; }

for threads in 1 3; do
  run --threads $threads -o "$folder/threads.h5"
  same "$threads threads" "$folder/threads.h5"
done
sets=$("$bristle" info "$result" | sed -n 's/^ *cpu_features  *//p')
[ -n "$sets" ] || failed "the result names no instruction set"
for set in $sets; do
  run --instruction-set "$set" -o "$folder/set.h5"
  same "$set" "$folder/set.h5"
done
for i in 3 1 2; do
  run --shard $i/3 -o "$folder/shards/r.h5"
done
"$bristle" run "$experiment" --tier smoke --complete --quiet -o "$folder/shards/r.h5"
same "three shards" "$folder/shards/r.h5"
exit $((failures > 0))
