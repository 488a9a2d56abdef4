#!/bin/bash
# A smoke tier computed in a different way has the same numbers bit for bit. RESULT was computed by BRISTLE (one
# compiler, -O3, all threads, the widest vectors); OTHER is the program built by the other compiler at -O2.
# usage: bits_test.sh BRISTLE OTHER EXPERIMENT RESULT
set -u
bristle=$1 other=$2 experiment=$3 result=$4
. "$(dirname "$0")/shell.sh"
expected=$(digest "$result")
[ -n "$expected" ] || { echo "FAILED: $result has no digest that verifies"; exit 1; }

if [ -x "$other" ]; then
  "$other" run "$experiment" --tier smoke --force --quiet --threads 1 -o "$folder/other.h5"
  same "$("$other" info "$folder/other.h5" | sed -n 's/^ *compiler  *//p'), -O2, one thread" "$folder/other.h5"
else
  echo "the other compiler is not installed"
  exit 77
fi
exit $failures
