#!/bin/bash
# The options --shard and the command merge. usage: merge_test.sh BRISTLE, from the repository's root.
set -u
bristle=$1
. "$(dirname "$0")/shell.sh"

# Thirty quick points, with tables.
run=("$bristle" run experiments/fig4.json --tier smoke --set '/orientation={"sampling":"list","theta_0_deg":[10,100]}'
  --set '/record=["bristles","trajectories"]')
part() { echo "$folder/r.$1-of-$2.h5"; }

for shard in 0/3 4/3 a/b 1/0 3 ""; do expect 2 "--shard $shard: " "${run[@]}" --shard "$shard" -o "$folder/x.h5"; done
expect 2 "numbered 1/3 to 3/3" "${run[@]}" --shard 4/3 -o "$folder/x.h5"
mkdir "$folder/whole"
expect 0 "30 ok" "${run[@]}" -o "$folder/whole/r.h5" --set /load='{"z_0":0.5,"R_n":null}'
run+=(--set /load='{"z_0":0.5,"R_n":null}')
for n in 1 4 37; do
  for i in $(seq $n); do expect 0 "points: " "${run[@]}" --shard "$i/$n" -o "$(part "$i" $n)" --threads $((i % 2 + 1)) --force; done
  expect 0 "30 points of $n parts" "$bristle" merge -o "$folder/r.h5" "$folder"/r.*-of-$n.h5
  expect 0 "the same, bit for bit" "$bristle" diff "$folder/r.h5" "$folder/whole/r.h5"
  [ "$(digest "$folder/r.h5")" = "$(digest "$folder/whole/r.h5")" ] || failed "digest of $n parts"
  rm "$folder/r.h5"
done
expect 0 "none in this shard" "${run[@]}" --shard 37/37 -o "$(part 37 37)" --force
expect 0 "is up to date" "${run[@]}" --shard 2/4 -o "$(part 2 4)"
expect 0 "part 2/4: 8 of 30 points" "$bristle" info "$(part 2 4)"
expect 0 "points: none" "$bristle" info "$(part 37 37)"

# Merging requires all parts, and a part is not accepted as a result.
expect 2 "8 of 30 points are missing: 1 (azimuth_rate = kinematic, k_r = 3, k_theta = 1.00795)" \
  "$bristle" merge -o "$folder/r.h5" "$(part 1 4)" "$(part 3 4)" "$(part 4 4)"
[ ! -e "$folder/r.h5" ] || failed "a merge of too few parts left a result"
command=$("$bristle" merge -o "$folder/r.h5" "$(part 1 4)" "$(part 3 4)" "$(part 4 4)" 2>&1 | tail -n 1)
rm "$(part 2 4)"
eval "$command --quiet" || failed "the command that was named: $command"
expect 0 "30 points of 4 parts" "$bristle" merge -o "$folder/r.h5" "$folder"/r.?-of-4.h5
expect 0 "part_4" "$bristle" info "$folder/r.h5"
first="merge the parts first: bristle merge -o $folder/r.h5 $folder/r.*-of-4.h5"
expect 2 "$first" "$bristle" check "$(part 2 4)"
expect 2 "$first" "$bristle" diff "$folder/r.h5" "$(part 2 4)"
expect 2 "a part (2/4) of fig4" scripts/plot fig4 "$(part 2 4)" -o "$folder"
expect 2 "is not a part of a result of bristle" "${run[@]}" --shard 1/4 -o "$folder/r.h5"
expect 2 "is one of the parts" "$bristle" merge -o "$(part 1 4)" "$folder"/r.?-of-4.h5
expect 2 "not a part of one" "$bristle" merge -o "$folder/x.h5" "$folder/r.h5"
expect 2 "not an HDF5 file" "$bristle" merge -o "$folder/x.h5" CMakeLists.txt
expect 2 "no such file" "$bristle" merge -o "$folder/x.h5" nowhere.h5
expect 2 "PARTS" "$bristle" merge -o "$folder/x.h5"
expect 2 "--output" "$bristle" merge "$(part 1 4)"
exit $((failures > 0))
