#!/bin/bash
# The options --shard and --complete. usage: shards_test.sh BRISTLE, from the repository's root.
set -u
bristle=$1
. "$(dirname "$0")/shell.sh"

# Forty-five quick points, with tables.
run=("$bristle" run experiments/fig4.json --tier smoke --set '/orientation={"sampling":"list","theta_0_deg":[10,100]}'
  --set '/record=["bristles","trajectories"]')

for shard in 0/3 4/3 a/b 1/0 3 ""; do expect 2 "--shard $shard: " "${run[@]}" --shard "$shard" -o "$folder/x.h5"; done
expect 2 "numbered 1/3 to 3/3" "${run[@]}" --shard 4/3 -o "$folder/x.h5"
expect 2 "excludes --complete" "${run[@]}" --shard 1/3 --complete -o "$folder/x.h5"
expect 2 "excludes --complete" "${run[@]}" --force --complete -o "$folder/x.h5"
run+=(--set /load='{"z_0":0.5,"R_n":null}')
mkdir "$folder/whole"
expect 0 "45 ok" "${run[@]}" -o "$folder/whole/r.h5"
for n in 1 4 37; do
  r=$folder/of-$n/r.h5
  for i in $(seq $n); do expect 0 "points: " "${run[@]}" --shard "$i/$n" -o "$r" --threads $((i % 2 + 1)); done
  [ ! -e "$r" ] || failed "shards wrote a result"
  expect 0 "45 ok; 45 computed before" "${run[@]}" --complete -o "$r"
  expect 0 "the same, bit for bit" "$bristle" diff "$r" "$folder/whole/r.h5"
  [ "$(digest "$r")" = "$(digest "$folder/whole/r.h5")" ] || failed "digest of $n shards"
  [ "$(ls "$folder/of-$n")" = "$(printf 'r.h5\nr.h5.journal')" ] || failed "journals are left: $(ls "$folder/of-$n")"
  expect 0 "is up to date" "${run[@]}" --shard 1/$n -o "$r"
done
r=$folder/r.h5
expect 0 "none in this shard" "${run[@]}" --shard 47/47 -o "$r"
expect 0 "34 of 45 points of fig4 are not yet in the journals of this folder" "${run[@]}" --shard 2/4 -o "$r"
expect 0 "11 computed before" "${run[@]}" --shard 2/4 -o "$r"

# The completion requires all points, and computes none.
for i in 1 3; do expect 0 "points: " "${run[@]}" --shard $i/4 -o "$r"; done
rm "$r.2-of-4.journal" "$r.47-of-47.journal"
command=("${run[@]}" -o "$r" --complete)
expect 2 "22 of 45 points are missing in the journals of its folder: 1 (bending = polar, k_r = 5, k_theta = 1.00795)" \
  "${command[@]}"
{ [ ! -e "$r" ] && [ ! -e "$r.journal" ]; } || failed "a completion with too few points left a file"
command=$("${command[@]}" 2>&1 | tail -n 1)
for shard in 2/4 4/4; do
  # shellcheck disable=SC2001 # a pattern
  eval "$(sed "s|--shard 2/4|--shard $shard|" <<<"$command") --quiet" || failed "the command that was named: $command"
done
expect 0 "45 ok; 45 computed before" "${run[@]}" --complete -o "$r"
[ "$(digest "$r")" = "$(digest "$folder/whole/r.h5")" ] || failed "digest of the completion"
expect 0 "points_hosts" "$bristle" info "$r"
[ "$(cd "$folder" && ls -d r.*)" = "$(printf 'r.h5\nr.h5.journal')" ] || failed "journals are left: $(ls "$folder")"

# A run without these options computes what the shards have not.
r=$folder/rest/r.h5
expect 0 "points: " "${run[@]}" --shard 2/3 -o "$r"
expect 0 "45 ok; 15 computed before" "${run[@]}" -o "$r"
[ "$(digest "$r")" = "$(digest "$folder/whole/r.h5")" ] || failed "digest of a shard and the rest"

# Journals of another experiment are named; other files are no outputs.
expect 0 "points: " "${run[@]}" --shard 1/2 -o "$folder/foreign/r.h5" --set /model/k_phi=2
expect 2 "r.h5.1-of-2.journal has 23 points, but none can be used" "${run[@]}" --complete -o "$folder/foreign/r.h5"
expect 2 "is not a result of bristle" "${run[@]}" --shard 1/2 -o CMakeLists.txt

# The analysis of a sample, whose points are in the journals of two shards; a design cannot be split.
run=("$bristle" run experiments/paper.json --set '/orientation={"sampling":"list","theta_0_deg":[10,100]}')
sample=(--set '/sweep/sample={"sobol":8,"seed":1,"over":{"k_r":{"log":[5,50]},"k_theta":{"uniform":[0.5,4]}}}'
  --set '/analysis={"sobol_indices":["R_x"],"quantiles":["R_x"]}')
expect 0 "shares in the variance of R_x (Sobol indices)" "${run[@]}" "${sample[@]}" -o "$folder/whole/sample.h5"
for i in 2 1; do expect 0 "points: " "${run[@]}" "${sample[@]}" --shard $i/2 -o "$folder/sample.h5"; done
expect 0 "32 computed before" "${run[@]}" "${sample[@]}" --complete -o "$folder/sample.h5"
expect 0 "the same, bit for bit" "$bristle" diff "$folder/sample.h5" "$folder/whole/sample.h5"
expect 2 "a search cannot be split into shards" "${run[@]}" --shard 1/2 -o "$folder/x.h5" \
  --set '/design={"variables":{"k_r":[2,20]},"budget":8,"objective":{"minimise":"R_x"}}'
exit $((failures > 0))
