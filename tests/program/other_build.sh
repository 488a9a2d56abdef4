#!/bin/sh
# Builds the program with the other compiler at -O2 in FOLDER. usage: other_build.sh SOURCE FOLDER COMPILER_ID
# Exit code 77 (skipped) if that compiler is not installed.
set -eu
case $3 in
  GNU) other=clang++ ;;
  *) other=g++ ;;
esac
command -v $other >/dev/null || { echo "$other is not installed"; exit 77; }
cmake -S "$1" -B "$2" -G Ninja -DCMAKE_CXX_COMPILER=$other -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O2 -DNDEBUG" \
  -DBRISTLE_KERNEL_OPTIMISATION=-O2 -DBRISTLE_TESTS=OFF >/dev/null
exec ninja -C "$2" --quiet bristle
