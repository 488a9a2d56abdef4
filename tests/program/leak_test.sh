#!/bin/sh
# leak_test.sh NM OBJECT...: weak symbols, which other objects may define as well, must have the instruction set in their
# names.
set -eu
nm=$1
shift
for object in "$@"; do
  [ -s "$object" ] || { echo "no such object: $object" >&2; exit 1; }
  "$nm" -C "$object" | grep -q ' W .*bristle::N_' || { echo "$object: contains no code of its instruction set" >&2; exit 1; }
  if "$nm" -C "$object" | grep ' [WV] ' | grep -v '::N_[A-Z0-9_]*::'; then
    echo "$object: the symbols above are compiled for one instruction set, but the linker could use them for all" >&2
    exit 1
  fi
done
