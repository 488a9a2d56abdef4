#!/bin/bash
# One experiment, computed in every way that this machine has, gives the same bits: numbers of threads, sets of vector
# instructions, parts merged. usage: ways_test.sh BRISTLE EXPERIMENT RESULT FOLDER
set -u
bristle=$1 experiment=$2 result=$3 folder=$4
rm -rf "$folder" && mkdir -p "$folder"
failures=0
digest() { "$bristle" info "$1" | sed -n 's/^payload sha256 \(.*\) (verified)$/\1/p'; }
expected=$(digest "$result")
[ -n "$expected" ] || { echo "FAILED: $result has no digest that verifies"; exit 1; }
compare() {
  if [ "$(digest "$2")" = "$expected" ]; then echo "the same: $1"; return; fi
  echo "FAILED: $1: $(digest "$2"), not $expected"
  failures=$((failures + 1))
}
run() { "$bristle" run "$experiment" --tier smoke --force --quiet "$@"; }

for threads in 1 3; do
  run --threads $threads -o "$folder/threads.h5"
  compare "$threads threads" "$folder/threads.h5"
done
sets=$("$bristle" info "$result" | sed -n 's/^ *cpu_features  *//p')
[ -n "$sets" ] || { echo "FAILED: no instruction set is known"; failures=$((failures + 1)); }
for set in $sets; do
  run --instruction-set "$set" -o "$folder/set.h5"
  compare "$set" "$folder/set.h5"
done
for i in 1 2 3; do
  run --shard $i/3 -o "$folder/part$i.h5"
done
"$bristle" merge -o "$folder/merged.h5" "$folder"/part[321].h5
compare "three parts, merged" "$folder/merged.h5"
exit $((failures > 0))
