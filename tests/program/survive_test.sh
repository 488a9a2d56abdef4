#!/bin/bash
# However a run ends, no computed point is lost and no file is left incomplete. usage: survive_test.sh BRISTLE KILLS
set -u
bristle=$1 wanted=$2
. "$(dirname "$0")/shell.sh"
mounted=
cleanup() {
  [ -z "$mounted" ] || umount "$mounted"
  rm -rf "$folder"
}
trap cleanup EXIT
RANDOM=${SEED:-$$}
echo "seed $RANDOM (SEED=... repeats)"

run() { "$bristle" run experiments/paper.json "${options[@]}" "$@"; }
r=$folder/results/r.h5
points() { if [ -f "$r.journal" ]; then wc -l <"$r.journal"; else echo 0; fi; }
# subject OPTION...: runs the experiment with these options undisturbed, and for the old result with a different stiffness.
subject() {
  options=("$@" --set '/orientation={"sampling":"list","theta_0_deg":[10,20,40,55,70,85,100,115,130,145,160,170]}'
    --set '/load={"R_n":null,"z_0":0.5}' --set /integrator/engine=reference --quiet)
  again=("$bristle" run experiments/paper.json "${options[@]}" -o "$r")  # an array, because a function in the background would run in another shell
  rm -f "$folder"/*.h5*
  run -o "$folder/undisturbed.h5" || failed "the undisturbed run"
  all=$(wc -l <"$folder/undisturbed.h5.journal")
  run -o "$folder/old.h5" --set /model/k_phi=2.5 || failed "the old result"
  new=$(digest "$folder/undisturbed.h5") old=$(digest "$folder/old.h5")
  [ -n "$new" ] && [ -n "$old" ] && [ "$new" != "$old" ] || failed "digests of the undisturbed runs: '$new' and '$old'"
  rm "$folder"/*.journal
}
# The result must be the old or the new one, complete.
whole() {
  local is
  is=$(digest "$r")
  [ "$is" = "$old" ] || [ "$is" = "$new" ] || failed "$1: the result is neither the old nor the new one: $("$bristle" info "$r" 2>&1 | head -n 2)"
}
# Creates a new folder with the old result.
begin() {
  rm -rf "$folder/results"
  mkdir "$folder/results"
  cp "$folder/old.h5" "$r"
}
finish() {
  run -o "$r" || failed "$1: the run that continues"
  [ "$(digest "$r")" = "$new" ] || failed "$1: other numbers than those of the undisturbed run"
  [ ! -e "$r.partial" ] || failed "$1: a partial file is left"
}

# killed TIMES: killed repeatedly after up to seven further points and a random time, until one run finishes. The number
# of points, not the time alone, decides: however busy the machine is, most kills come between the first point and the last.
killed() {
  local kills=0 kept=0 before after until pid i
  while [ $kills -lt "$1" ]; do
    begin
    for ((i = 0; i < 60; ++i)); do
      before=$(points)
      "${again[@]}" &
      pid=$!
      until=$((before + RANDOM % 8))
      while [ "$(points)" -lt "$until" ] && kill -0 $pid 2>/dev/null; do sleep 0.005; done
      sleep "0.0$(printf %02d $((RANDOM % 30)))"
      if kill -KILL $pid 2>/dev/null; then kills=$((kills + 1)); fi
      wait $pid 2>/dev/null && break
      whole "kill -9"
      after=$(points)
      [ "$after" -ge "$before" ] || failed "kill -9: $before points were saved, then $after"
      [ "$after" -gt 0 ] && [ "$after" -lt "$all" ] && kept=$((kept + 1))
    done
    finish "kill -9"
  done
  [ $((8 * kept)) -gt $kills ] || failed "only $kept of $kills kills came between the first point and the last"
  echo "$kills kills, $kept of them between the first point and the last of $all"
}

if [ "$wanted" -ge 40 ]; then
  # A design, whose trials follow from each other, with what is computed beside the one that it recommends.
  subject --set '/design={"variables":{"k_r":[2,20]},"budget":8,"objective":{"minimise":"R_x"}}'
  killed "$wanted"
  # A sample and its analysis.
  subject --set '/sweep/sample={"sobol":8,"seed":1,"over":{"k_r":{"log":[2,20]},"k_theta":{"uniform":[0.5,4]}}}' \
    --set '/analysis={"sobol_indices":["R_x"],"quantiles":["R_n"]}'
  killed "$wanted"
fi
# A sweep of 32 points that take about a second.
subject --set '/sweep={"k_r":{"logspace":[2,20,8]},"k_theta":{"values":[0.5,1,2,4]}}'
killed "$wanted"

# Killed while the result is written, when all points are in the journal.
for ((i = 0; 2 * i < wanted; ++i)); do
  cp "$folder/old.h5" "$r"
  "${again[@]}" &
  pid=$!
  sleep "0.0$(printf %02d $((RANDOM % 60)))"
  kill -KILL $pid 2>/dev/null
  wait $pid 2>/dev/null
  whole "kill -9 while writing"
done
finish "kill -9 while writing"

# Ctrl-C and SIGTERM: report the saved points, exit code 128 plus the signal, and the same command resumes. `timeout`
# passes Ctrl-C on, so that the signal arrives twice.
begin
"${again[@]}" 2>"$folder/log" &
pid=$!
while [ "$(points)" -lt 3 ]; do sleep 0.01; done
kill -TERM $pid
wait $pid
[ $? = 143 ] || failed "SIGTERM: exit code"
whole "SIGTERM"
finish "SIGTERM"
begin
"${again[@]}" 2>"$folder/log" &
pid=$!
while [ "$(points)" -lt 3 ]; do sleep 0.01; done
kill -INT $pid
kill -INT $pid
wait $pid
[ $? = 130 ] || failed "Ctrl-C: exit code"
grep -q "interrupted; [0-9]* of 32 points are saved in $r.journal: the same command computes the rest" "$folder/log" ||
  failed "Ctrl-C: $(cat "$folder/log")"
saved=$(sed -n 's/.*interrupted; \([0-9]*\) of.*/\1/p' "$folder/log")
[ "$saved" = "$(points)" ] || failed "Ctrl-C: $saved points are said to be saved, $(points) are"
whole "Ctrl-C"
finish "Ctrl-C"
grep -q "32" <<<"$(points)" || failed "Ctrl-C: $(points) points in the journal after the continuation, not 32"

begin
"${again[@]}" --force 2>"$folder/log" &
pid=$!
while [ "$(points)" -lt 3 ]; do sleep 0.01; done
kill -INT $pid
wait $pid
grep -q "points are saved in $r.journal: the same command without --force computes the rest" "$folder/log" ||
  failed "Ctrl-C with --force: $(cat "$folder/log")"
whole "Ctrl-C with --force"
finish "Ctrl-C with --force"

# Full disk: a limit on the size of files and, if mounting is allowed, a small file system.
no_room() {
  whole "$1"
  grep -qE "No space left|File too large" "$folder/log" || failed "$1: $(cat "$folder/log")"
  grep -qE "saved in .*: the same command (computes the rest|writes the result)" "$folder/log" || failed "$1: $(cat "$folder/log")"
}
for size in 2 16 40; do
  begin
  (ulimit -f $size; run -o "$r" 2>"$folder/log")
  [ $? = 3 ] && no_room "files of at most $size KiB" || failed "files of at most $size KiB: exit code, $(cat "$folder/log")"
  finish "files of at most $size KiB"
done
begin
run -o "$r" && cp "$folder/old.h5" "$r"
(ulimit -f 16; run -o "$r" 2>"$folder/log")
[ $? = 3 ] && no_room "no room for the result" || failed "no room for the result: exit code, $(cat "$folder/log")"
finish "no room for the result"
begin
size=$(stat -c %s "$folder/old.h5")
if mount -t tmpfs -o size=$((4 * size)) none "$folder/results" 2>/dev/null; then
  mounted=$folder/results
  cp "$folder/old.h5" "$r"
  head -c $((5 * size / 2)) /dev/zero >"$folder/results/ballast"
  run -o "$r" 2>"$folder/log"
  [ $? = 3 ] && no_room "a full disk" || failed "a full disk: exit code, $(cat "$folder/log")"
  rm "$folder/results/ballast"
  finish "a full disk"
  umount "$folder/results" && mounted=
else
  echo "no file system may be mounted here: the full disk is left out"
fi

# Two runs at the same time: the second is refused.
begin
"${again[@]}" &
pid=$!
while [ "$(points)" -lt 1 ]; do sleep 0.01; done
run -o "$r" 2>"$folder/log"
[ $? = 3 ] && grep -q "another run is writing it" "$folder/log" || failed "two runs: $(cat "$folder/log")"
wait $pid || failed "two runs: the first"
[ "$(digest "$r")" = "$new" ] || failed "two runs: the numbers"

# A finer grid computes its new points only; a touched file and a new title cause no computation.
begin
run -o "$r"
touch experiments/paper.json
finer=$("$bristle" run experiments/paper.json "${options[@]/--quiet/--set=/title=finer}" -o "$r" \
  --set '/sweep/k_theta/values=[0.5,0.7,1,2,4]')
grep -q "32 computed before" <<<"$finer" || failed "a finer grid: $finer"
[ "$(points)" = 40 ] || failed "a finer grid: $(points) points in the journal, not 40"
exit $((failures > 0))
