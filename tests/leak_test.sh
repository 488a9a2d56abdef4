#!/bin/sh
# leak_test.sh NM OBJECT...: code that another object may define too ("weak") must carry its instruction set in its name.
set -eu
nm=$1
shift
for object in "$@"; do
  [ -s "$object" ] || { echo "no such object: $object" >&2; exit 1; }
  "$nm" -C "$object" | grep -q ' W .*bristle::N_' || { echo "$object: no code of its instruction set" >&2; exit 1; }
  if "$nm" -C "$object" | grep ' [WV] ' | grep -v '::N_[A-Z0-9_]*::'; then
    echo "$object: the code above is compiled for one instruction set, but could be linked for all" >&2
    exit 1
  fi
done
