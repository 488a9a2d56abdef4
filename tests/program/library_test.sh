#!/bin/bash
# Installs the library into a temporary prefix, builds the examples against it, and compares their numbers with those of
# the program. usage: library_test.sh BRISTLE BUILD CXX, from the repository's root.
set -u
bristle=$1 build=$(realpath "$2") cxx=$3
. "$(dirname "$0")/shell.sh"
prefix=$folder/usr
cmake --install "$build" --prefix "$prefix" >"$folder/log" 2>&1 || failed "cmake --install: $(tail -n 3 "$folder/log")"
cmake -S examples -B "$folder/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >"$folder/log" 2>&1 || failed "find_package: $(tail -n 5 "$folder/log")"
cmake --build "$folder/build" >"$folder/log" 2>&1 || failed "the examples: $(grep -E 'error|warning' "$folder/log" | head -n 5)"

# One point is that of the experiment with the same parameters.
cat >"$folder/one.json" <<'JSON'
{"extends": "paper.json", "name": "one", "model": {"bending": "rod", "k_r": 30}}
JSON
cp experiments/paper.json "$folder"
"$bristle" run "$folder/one.json" -o "$folder/one.h5" --quiet || failed "the experiment"
expected=$("$bristle" export "$folder/one.h5" -o - | awk -F, '/^#/ {next} !names {for (i = 1; i <= NF; ++i) at[$i] = i; names = 1; next}
  {printf "R_n = %.6g +- %.1g\nR_x relative to rigid bristles = %.6g +- %.1g\n", $at["R_n"], $at["R_n_err"], $at["R_x_norm"], $at["R_x_norm_err"]}')
found=$("$folder/build/one_point")
[ "$found" = "$expected" ] || failed "one_point printed $found, not $expected"

expect 0 "(ok)" "$folder/build/load_sweep"
[ "$("$folder/build/load_sweep" | grep -c '(ok)$')" = 6 ] || failed "load_sweep: $("$folder/build/load_sweep")"

# What the library is free of: JSON, HDF5, threads and text formatting.
for word in nlohmann H5F fmt:: pthread_create; do
  nm -C "$build/libbristle.a" 2>/dev/null | grep -qF "$word" && failed "libbristle.a names $word"
done
exit $((failures > 0))
