#!/bin/bash
# The commands that messages advise are executed in the situation in which they are printed: each does what the message says,
# and no computed point is lost. usage: advice_test.sh BRISTLE SOURCE
set -u
bristle=$1 source=$2
. "$(dirname "$0")/shell.sh"
python=$("$source/scripts/find-python" numpy h5py) || { echo "no python3 with numpy and h5py"; exit 1; }
mkdir "$folder/bin" && ln -s "$bristle" "$folder/bin/bristle" && PATH=$folder/bin:$PATH  # messages say bristle

mkdir "$folder/work" && cd "$folder/work" || exit 1
git init -q . && mkdir results && cp "$source/experiments/paper.json" . && printf '/results/\n/log\n' >.gitignore
gap='"load": { "z_0": 0.9, "R_n": null, "path": null }'
quick='"extends": "paper.json",
  "orientation": { "sampling": "list", "theta_0_deg": [20, 160], "rtol": null }'
sweep='"sweep": { "friction": { "values": ["nss", "coulomb"] }, "k_r": { "logspace": [5, 20, 3] } },
  "tiers": { "smoke": { "sweep": { "k_r": { "take": [0, 2] } } } }'
echo "{ $quick, $gap, \"name\": \"quick\", $sweep }" >quick.json
printf 'friction,k_r\nnss,1e1\ncoulomb,20.000000000000004\nnss,7\n' >rows.csv
echo "{ $quick, $gap, \"name\": \"table\", \"sweep\": { \"sample\": { \"table\": \"rows.csv\" } } }" >table.json
echo "{ $quick, $gap, \"name\": \"sobol\", \"sweep\": { \"sample\": { \"sobol\": 2, \"seed\": 1, \"over\": { \"k_r\": { \"log\": [5, 20] },
  \"tau_f\": { \"normal\": [3e4, 1e3] } } } }, \"analysis\": { \"sobol_indices\": [\"R_x\"] } }" >sobol.json
echo "{ $quick, $gap, \"name\": \"design\", \"design\": { \"variables\": { \"k_r\": [5, 20] }, \"objective\": { \"minimise\": \"R_x\" },
  \"budget\": 6, \"seed\": 1 }, \"tiers\": { \"smoke\": { \"design\": { \"budget\": 4 } } } }" >design.json
git add . && git -c user.name=n -c user.email=e commit -qm m

# advised COMMAND...: the first command between backquotes in what it prints, or after "To compute" on a line of its own.
advised() { "$@" 2>&1 | grep -o '`bristle [^`]*`' | head -n 1 | tr -d '`'; }
kept() { sha256sum "$@"; }  # what must stay as it is
# same_point RESULT POINT: results/replay.h5 has the numbers of this point, bit for bit.
same_point() {
  "$python" - "$1" "$2" <<'END' || failed "the point $2 of $1"
import h5py, sys
import numpy as np
one, all = h5py.File("results/replay.h5"), h5py.File(sys.argv[1])
at = np.unravel_index(int(sys.argv[2]), all["status"].shape)
names = [n for n in all if isinstance(all[n], h5py.Dataset) and all[n].shape == all["status"].shape and n in one and n != "sample"]
assert len(names) > 20, names
for n in names:
    assert np.asarray(one[n][()]).ravel().tobytes() == np.asarray(all[n][at]).ravel().tobytes(), n
END
}

# A point of any result is computed again by the command for it.
replay() {  # RESULT
  local point command
  for point in 0 -1; do
    command=$("$bristle" check --json --reference none "$1" | "$python" -c "import json, sys; print(json.load(sys.stdin)['replay'][$point])")
    rm -f results/replay.h5
    eval "$command --quiet" >log 2>&1 || failed "$command: $(cat log)"
    same_point "$1" "${command##* }"
  done
}
run() { "$bristle" run "$@" --quiet >log 2>&1 || failed "run $*: $(cat log)"; }
for name in table sobol design quick; do run $name.json && replay results/$name.h5; done
run quick.json --tier smoke && replay results/quick-smoke.h5
run quick.json --set /model/mu_c=0.5 -o "results/a name.h5" && replay "results/a name.h5"
"$bristle" run - --quiet <quick.json -o results/piped.h5 && replay results/piped.h5
"$bristle" run table.json -o - --quiet >results/stdout.h5 2>/dev/null && replay results/stdout.h5
for i in 1 2; do run quick.json --shard $i/2 -o results/shards.h5; done
run quick.json --complete -o results/shards.h5 && replay results/shards.h5
sed -i 's/"z_0": 0.9/"z_0": 0.8/' quick.json && replay results/quick.h5  # a changed file
mv quick.json results/hidden.json && replay results/quick.h5 && git checkout -q quick.json
expect 2 "holds 6 points" "$bristle" run results/quick.h5 --point 1 -o results/quick.h5
expect 2 "--point 6: results/quick.h5 has the points 0 to 5" "$bristle" run results/quick.h5 --point 6

# A reference from a full result: the advice computes the smoke tier beside it.
before=$(kept results/quick.h5 results/quick.h5.journal)
rm -f results/quick-smoke.h5*
command=$(advised "$bristle" reference update results/quick.h5 --reason r)
eval "$command" >log 2>&1 || failed "$command: $(cat log)"
[ "$before" = "$(kept results/quick.h5 results/quick.h5.journal)" ] || failed "$command changed the full result"
[ -e results/quick-smoke.h5 ] || failed "$command wrote no results/quick-smoke.h5"
# As if by a program without changes.
"$python" -c 'import h5py, numpy
with h5py.File("results/quick-smoke.h5", "r+") as file:
    for name in ("commit", "points_commits"): file["provenance"].attrs[name] = numpy.bytes_("0123456789")'
for options in "" "--reference other"; do
  command=$(advised "$bristle" check results/quick-smoke.h5 $options | sed 's/"\.\.\."/first/')
  eval "$command" >log 2>&1 || failed "$command: $(cat log)"
  expect 0 "the same, bit for bit" "$bristle" check results/quick-smoke.h5 $options
  git add . && git -c user.name=n -c user.email=e commit -qm references
done
for remedy in checkout update; do
  echo "{" >reference/quick.json
  expect 2 "restore the reference with" "$bristle" check results/quick-smoke.h5
  if [ $remedy = checkout ]; then
    eval "$("$bristle" check results/quick-smoke.h5 2>&1 | grep -o '`git [^`]*`' | tr -d '`')"
  else
    rm reference/quick.json
    expect 0 "new reference" "$bristle" reference update results/quick-smoke.h5 --reason again
  fi
  expect 0 "the same, bit for bit" "$bristle" check results/quick-smoke.h5
done

# A reference is not written from a program with changes: the result is computed again at its place.
"$python" -c 'import h5py, numpy
with h5py.File("results/quick-smoke.h5", "r+") as file:
    for name in ("commit", "points_commits"): file["provenance"].attrs[name] = numpy.bytes_("0123456789-dirty")'
git add . && git -c user.name=n -c user.email=e commit -qm again
update=("$bristle" reference update results/quick-smoke.h5 --reason r --reference fresh)
expect 2 "commit, build, then" "${update[@]}"
eval "$(advised "${update[@]}") --quiet" >log 2>&1 || failed "a run: $(cat log)"
expect 0 "the same, bit for bit" "$bristle" check results/quick-smoke.h5

# What is missing or damaged is computed; values at a point that is not there are found among all.
expect 2 "results/none.h5: no such file" "$bristle" info results/none.h5
command=$(advised "$bristle" info results/none.h5)
eval "${command/EXPERIMENT.json/quick.json} --quiet" >log 2>&1 || failed "$command: $(cat log)"
expect 0 "points: 6 ok" "$bristle" info results/none.h5
"$python" -c 'import h5py
with h5py.File("results/none.h5", "r+") as file: file["R_x"][0] += 1'
expect 2 "compute it again with \`bristle run\`" "$bristle" value results/none.h5 R_x
expect 0 "" "$bristle" run quick.json -o results/none.h5 --quiet
value=("$bristle" value results/table.h5 R_x --at friction=coulomb --at k_r=7)
expect 2 "no point is at friction=coulomb, k_r=7" "${value[@]}"
eval "$(advised "${value[@]}")" >log 2>&1 || failed "all values: $(cat log)"
[ "$(grep -c 'k_r = ' log)" = 3 ] || failed "not all values: $(cat log)"

# Another tier does not replace a result; a forced run leaves the other points in the journal.
expect 2 "holds the result of the full tier, which the smoke tier would replace; give another file with -o" \
  "$bristle" run quick.json --tier smoke -o results/quick.h5
expect 2 "holds the result of the full tier" "$bristle" design design.json --tier smoke -o results/design.h5
expect 0 "is up to date: nothing to compute (--force computes it again)" "$bristle" run quick.json
lines=$(wc -l <results/quick.h5.journal)
run quick.json --tier smoke --force -o results/quick.h5
[ "$(wc -l <results/quick.h5.journal)" -ge "$lines" ] || failed "--force removed points of another tier"
expect 0 "points: 6 ok; 6 computed before" "$bristle" run quick.json

# Shards: what remains to be done, also after forced ones and from standard input.
next() { sed -n 's/^  \(.*bristle.*\)/\1/p' log | head -n 1 | sed 's/< EXPERIMENT.json/<quick.json/'; }
"$bristle" run quick.json --force --shard 1/2 -o results/forced.h5 >log 2>&1 || failed "a shard: $(cat log)"
"$bristle" run quick.json --complete -o results/forced.h5 >log 2>&1
eval "$(next)" >log 2>&1 || failed "the missing shard: $(cat log)"
eval "$(next)" >log 2>&1 || failed "completion: $(cat log)"
expect 0 "points: 6 ok" "$bristle" info results/forced.h5
for i in 1 2; do "$bristle" run - --shard $i/2 -o results/piped2.h5 <quick.json >log 2>&1; done
eval "$(next)" >log 2>&1 || failed "completion from standard input: $(cat log)"
[ -e results/piped2.h5 ] || failed "no result from standard input"

# The first steps.
expect 0 "mine.json: written" "$bristle" new mine
run mine.json --tier smoke
exit $((failures > 0))
