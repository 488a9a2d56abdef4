#!/bin/bash
# Checks that the programs of the benchmarks compile, which `make test` does not build.
# usage: benchmarks_test.sh BUILD TARGET...
cd "$1" || exit 2
shift
count=0
failed=0
while read -r command; do
  count=$((count + 1))
  eval "${command/ -c / -fsyntax-only }" || failed=1
done < <(ninja -t commands "$@" | grep ' -c [^ ]*/benchmarks/')
[ "$count" -ge 4 ] || { echo "only $count compiler commands found"; exit 1; }
exit $failed
