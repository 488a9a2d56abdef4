#!/bin/bash
# `make archive TIER=smoke` in a fresh clone: a draft that verifies, also by points computed again, and that no longer
# verifies once a byte has changed. usage: make_archive_test.sh SOURCE
set -u
source=$1
. "$(dirname "$0")/shell.sh"

git clone -q "$source" "$folder/clone" && cd "$folder/clone" || failed "no clone"
# What is to be computed is said first. Ctrl-C keeps what is computed, and the same command computes the rest.
make -s build >/dev/null || failed "no build"
timeout -s INT 5 make archive TIER=smoke >interrupted.log 2>&1 && failed "not interrupted: $(cat interrupted.log)"
grep -q "To be computed first, at most two minutes of processor time: fig2 .*fig4.* tuning" interrupted.log || failed "$(cat interrupted.log)"
finished=$(ls results/*-smoke.h5 | wc -l)
[ "$finished" -gt 0 ] || failed "nothing was kept"
touch kept
expect 0 "a draft, not to be cited: the results are of the smoke tier" make archive TIER=smoke
[ "$(find results -name '*-smoke.h5' ! -newer kept | wc -l)" = "$finished" ] || failed "finished results were computed again"
archive=$(ls dist/bristle-*-smoke.tar)
expect 0 "2 of 2 points computed again are the same, bit for bit" make verify ARCHIVE="$archive" RERUN=2
tar xOf "$archive" --wildcards '*/data/CITATION.cff' | grep -q "commit: \"$(git rev-parse HEAD)\"" || failed "the commit is not cited"
grep -q "commit $(git rev-parse HEAD)" report-smoke/index.html || failed "the report does not cite the commit"
size=$(stat -c %s "$archive")
for share in 1 3 5 7 9; do
  cp "$archive" flipped.tar
  at=$((size * share / 10))
  byte=$(od -An -tu1 -j $at -N 1 flipped.tar)
  printf "\\x$(printf %x $((byte ^ 1)))" | dd of=flipped.tar bs=1 seek=$at conv=notrunc status=none
  expect 1 "NOT as it was archived" build/bristle verify flipped.tar
done
exit $((failures > 0))
