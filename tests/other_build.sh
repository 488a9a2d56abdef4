#!/bin/sh
# Builds the program once more with the other compiler and at -O2, into FOLDER. usage: other_build.sh SOURCE FOLDER COMPILER_ID
# Exit code 77 (skipped) where that compiler is not installed.
set -eu
case $3 in
  GNU) other=clang++ ;;
  *) other=g++ ;;
esac
command -v $other >/dev/null || { echo "$other is not installed"; exit 77; }
cmake -S "$1" -B "$2" -G Ninja -DCMAKE_CXX_COMPILER=$other -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O2 -DNDEBUG" \
  -DBRISTLE_KERNEL_OPTIMISATION=-O2 -DBRISTLE_TESTS=OFF >/dev/null
exec ninja -C "$2" --quiet bristle
