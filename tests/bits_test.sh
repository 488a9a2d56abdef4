#!/bin/bash
# The numbers of a smoke tier, computed otherwise, are the same bit for bit. RESULT was computed by BRISTLE (one
# compiler, -O3, all threads, the widest vectors); OTHER is the program built by the other compiler at -O2.
# usage: bits_test.sh BRISTLE OTHER EXPERIMENT RESULT FOLDER
set -u
bristle=$1 other=$2 experiment=$3 result=$4 folder=$5
rm -rf "$folder" && mkdir -p "$folder"
failures=0
digest() { "$bristle" info "$1" | sed -n 's/^payload sha256 \(.*\) (verified)$/\1/p'; }
expected=$(digest "$result")
[ -n "$expected" ] || { echo "FAILED: $result has no digest that verifies"; exit 1; }
compare() {
  local what=$1 is
  is=$(digest "$2")
  if [ "$is" = "$expected" ]; then echo "the same: $what"; return; fi
  echo "FAILED: $what: $is, not $expected"
  "$bristle" diff "$result" "$2" | head -n 20
  failures=$((failures + 1))
}

if [ -x "$other" ]; then
  "$other" run "$experiment" --tier smoke --force --quiet --threads 1 -o "$folder/other.h5"
  compare "$("$other" info "$folder/other.h5" | sed -n 's/^ *compiler  *//p'), -O2, one thread" "$folder/other.h5"
else
  echo "the other compiler is not installed"
  exit 77
fi
exit $failures
