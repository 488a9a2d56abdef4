#!/bin/sh
# Builds the fuzz targets in FOLDER and runs each on its corpus, then for SECONDS on inputs that libFuzzer derives from it.
# usage: run.sh SOURCE FOLDER SECONDS. Exit code 77 (skipped) without a clang++ with libFuzzer.
set -eu
[ $# = 3 ] || { sed -n '3s/^# //p' "$0"; exit 2; }
mkdir -p "$2"
source=$(cd "$1" && pwd) folder=$(cd "$2" && pwd) seconds=$3
cd "$folder"

empty='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'
if ! echo "$empty" | clang++ -fsanitize=fuzzer,address -x c++ - -o probe >probe.log 2>&1; then
  echo "skipped: there is no clang++ with libFuzzer; install it with scripts/install-packages test-all"
  exit 77
fi
(cd "$source" && cmake --preset fuzz -B "$folder" -G Ninja) >configure.log 2>&1 || { cat configure.log; exit 1; }
nice -n 10 ninja --quiet fuzz

# `make sanitize` detects leaks. An input that takes more than two minutes is an error.
failed=
for corpus in "$source"/tests/fuzz/corpus/*/; do
  target=$(basename "$corpus")
  mkdir -p "found/$target"
  echo "$target: $(ls "$corpus" | wc -l) files, then $seconds s"
  if nice -n 10 "tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=120 -rss_limit_mb=4096 -detect_leaks=0 \
    -artifact_prefix="$folder/$target-" "found/$target" "$corpus" >"$target.log" 2>&1; then
    grep -E '^Done|DONE' "$target.log" | tail -n 1
  else
    failed="$failed $target"
    tail -n 40 "$target.log"
  fi
done
[ -z "$failed" ] || { echo "FAILED:$failed; the last lines above name the file with the input, in $folder"; exit 1; }
