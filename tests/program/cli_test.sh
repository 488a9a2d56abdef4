#!/bin/bash
# Exit codes and messages of the program. usage: cli_test.sh BRISTLE RESULT.h5
set -u
bristle=$1 result=$2
. "$(dirname "$0")/shell.sh"

expect 0 "validate" "$bristle" --help
expect 0 "--threads" "$bristle" run --help
expect 0 "bristle " "$bristle" --version
for command in new run design validate law schema info export value check diff cite archive verify assumptions \
    "reference update"; do
  expect 0 "  bristle $command" "$bristle" $command --help
done
expect 2 "bristle new mine" "$bristle"
expect 2 "bristle: unknown command rnu (did you mean run?); known: new, run, " "$bristle" rnu experiments/paper.json
expect 2 "bristle: figures are drawn by scripts/plot, or by bristle-plot once installed" "$bristle" plot fig4
expect 2 "run: unknown option -x; \`bristle run --help\`" "$bristle" run experiments/paper.json -x
expect 2 "--set model/k_r=3: a place in an experiment begins with /; write --set /model/k_r=20" "$bristle" validate experiments/paper.json --set model/k_r=3
expect 0 "bristle reference update " "$bristle" reference --help
expect 2 "reference: unknown command updat (did you mean update?)" "$bristle" reference updat
expect 2 "run: unknown option --tread (did you mean --threads?)" "$bristle" run experiments/paper.json --tread 2
expect 2 "run: unknown option --helpp (did you mean --help?)" "$bristle" run --helpp
expect 2 "unknown option --versio (did you mean --version?)" "$bristle" --versio
expect 2 "info: unexpected argument b" "$bristle" info a b
expect 2 'bristle: run: EXPERIMENT is required; `bristle run --help`' "$bristle" run
expect 2 "bristle: run: --tier: smok not in" "$bristle" run experiments/fig4.json --tier smok
expect 2 "aaa: cannot be read" "$bristle" run "$(printf 'a%.0s' {1..300})"
ln -s loop "$folder/loop"
expect 2 "loop: cannot be read" "$bristle" run "$folder/loop"
expect 2 "bristle: fig4: no such file; did you mean experiments/fig4.json?" "$bristle" run fig4
expect 2 "--tier" "$bristle" run experiments/paper.json --tier medium
expect 0 "2400 points" "$bristle" validate experiments/fig4.json
expect 0 "45 points" "$bristle" validate experiments/fig4.json --tier smoke
expect 2 "no such file" "$bristle" run nowhere.json
expect 2 "/model/k_r: -1 is not allowed" "$bristle" run experiments/paper.json --set /model/k_r=-1
expect 2 "/integrator/engine: \"fsat\" is not allowed" "$bristle" validate experiments/paper.json --set /integrator/engine=fsat
expect 0 "1 ok" "$bristle" run experiments/paper.json -o "$folder/e.h5" --set /integrator/engine=reference \
  --set /orientation/rtol=0.1
expect 2 "cannot be written" "$bristle" run experiments/paper.json -o /proc/nowhere/r.h5

# The friction laws of an experiment over the speed, and what to cite.
expect 0 "V_R,nss" "$bristle" law experiments/fig4.json
expect 0 "V_R,nss,coulomb" "$bristle" law experiments/fig7.json
[ "$("$bristle" law experiments/fig4.json | tail -n 1 | cut -c 1-8)" = "10,1.000" ] || failed "law: chi is not 1 at V_R = 10"
expect 0 "author = {Menga, N. and Bottiglione, F. and Carbone, G.}" "$bristle" cite
expect 0 "number = {4}" "$bristle" cite
expect 0 "pages = {3099--3112}" "$bristle" cite
expect 0 "@misc{bristle-" "$bristle" cite "$result"
digest=$("$bristle" info --json "$result" | sed -n 's/.*"payload_sha256": "\([0-9a-f]*\)".*/\1/p' | head -n 1)
expect 0 "SHA-256 of the numbers $digest;" "$bristle" cite "$result"
expect 2 "nowhere.h5: no such file" "$bristle" cite nowhere.h5
expect 2 'create it with `bristle run EXPERIMENT.json -o nowhere.h5`' "$bristle" info nowhere
expect 0 " contact, " "$bristle" info "$result"
expect 2 "--point: the number of a point is 0 or more" "$bristle" run experiments/fig4.json --point -1

# One number with its error, a table of a few variables, and keys without their blocks.
expect 0 " +- " "$bristle" value "$result" R_x_norm z_0 --at k_r=20 --at k_theta=1 --at bending=rod
[ "$("$bristle" value "$result" R_x_norm --at k_r=20 --at k_theta=1 --at bending=rod | wc -l)" = 1 ] || failed "value: not one line"
expect 0 " at bending = rod, k_r = " "$bristle" value "$result" R_x_norm --at k_r=20 --at k_theta=1 --at bending=rod
expect 0 '"bending": "rod"' "$bristle" value "$result" R_x_norm phase --at k_r=20 --json
"$bristle" value "$result" R_x_norm --at k_r=20 --at k_theta=1 --at bending=rod --json |
  python3 -c 'import json, sys; [one] = json.load(sys.stdin); assert one["R_x_norm"]["error"] > 0 and 20 < one["k_r"]["value"] < 22 and one["status"] == "ok"' ||
  failed "value --json: not one point with its error"
expect 2 "there is no variable R_x_nrm (did you mean R_x_norm?)" "$bristle" value "$result" R_x_nrm
expect 2 "there is no axis k_rr (did you mean k_r?)" "$bristle" value "$result" R_x_norm --at k_rr=20
expect 2 "bending has the words polar, polar_as_printed, rod" "$bristle" value "$result" R_x_norm --at bending=rode
expect 2 "--at k_r=soft: is not a number" "$bristle" value "$result" R_x_norm --at k_r=soft
expect 2 "--at k_r: write --at k_r=20" "$bristle" value "$result" R_x_norm --at k_r
expect 2 "--at k_r=1000: k_r is from" "$bristle" value "$result" R_x_norm --at k_r=1000
expect 2 "there is no variable k_theta=1; write --at k_theta=1" "$bristle" value "$result" R_x_norm --at k_r=20 k_theta=1
expect 0 "bending,k_r,k_theta,R_x_norm,R_x_norm_err,status" "$bristle" export "$result" --only R_x_norm -o -
expect 2 "--only R_x_nrm: there is no such variable (did you mean R_x_norm?)" "$bristle" export "$result" --only R_x_nrm
expect 2 "/model/k_r: -1 is not allowed" "$bristle" validate experiments/paper.json --set k_r=-1
expect 2 "rtol may be /orientation/rtol or /integrator/rtol; write --set /orientation/rtol=" \
  "$bristle" validate experiments/paper.json --set rtol=0.1
expect 0 "scatter, relative, of 16 different bristles: r0 normal with standard deviation 0.1, E uniform within +- 0.2" \
  "$bristle" validate experiments/paper.json --set '/scatter={"r0":{"normal":0.1},"E":{"uniform":0.2}}'
expect 2 "no block of an experiment has the key k_rr (did you mean k_r?)" "$bristle" validate experiments/paper.json --set k_rr=1

# A repository that checks its own numbers, and its values, which change.
model_of() {
  "$(scripts/find-python numpy h5py)" -c 'import h5py, json, sys
model = json.loads(h5py.File(sys.argv[1]).attrs["experiment"])["model"]
print("bending: " + model["bending"] + ", contact: " + model["contact"])' "$1"
}
own() (cd "$folder" && PATH=$(dirname "$bristle"):$PATH "$@")
expect 0 "own/: written, with an experiment, check.sh and a workflow" own bristle new own --repository
expect 2 "own: exists" own bristle new own --repository
expect 0 "5 points" own bristle validate own/own.json --set /sweep/friction=null
for option in "" --si; do
  expect 0 "begin$option.json: written" own bristle new "begin$option" $option
  own bristle run "begin$option.json" --set /sweep=null --set /orientation/rtol=0.5 --quiet
  expect 0 "bending: rod, contact: hertz" model_of "$folder/results/begin$option.h5"
done
grep -q "checkout [0-9a-f]\{40\} " "$folder/own/.github/workflows/check.yml" || failed "new --repository: no commit in the workflow"

# Standard input and standard output in place of files.
point='{"extends": "paper.json", "name": "piped", "orientation": {"rtol": 0.1}}'
piped() { printf %s "$1" | "$bristle" "${@:2}"; }
expect 0 "standard input: valid. piped: 1 point" piped "$point" validate -
expect 0 "1 ok" piped "$point" run - -o "$folder/named.h5"
piped "$point" run - -o - 2>"$folder/messages" | cat >"$folder/piped.h5"
grep -q "1 ok" "$folder/messages" || failed "run - -o -: no summary on standard error"
expect 0 "the same" "$bristle" diff "$folder/named.h5" "$folder/piped.h5"
expect 2 'standard input: /model/k_r: -1 is not allowed' piped "${point%?}, \"model\": {\"k_r\": -1}}" run -
expect 2 'standard input: /extends: "none.json" does not exist' piped '{"extends": "none.json", "name": "x"}' run -
expect 2 "standard input: " piped "" run -
expect 2 "standard input: expected a JSON object" piped "[1]" run -
expect 2 "-o -: shards have journals beside the result; name a file" piped "$point" run - -o - --shard 1/2
expect 130 "interrupted; -o - keeps no points" eval 'timeout --foreground --preserve-status -s INT 2 "$bristle" run experiments/fig5.json -o - | cat >/dev/null; exit_code=${PIPESTATUS[0]}; (exit $exit_code)'
expect 3 "or use another file system; -o - keeps no points" eval '(trap "" XFSZ; ulimit -f 20; "$bristle" run experiments/fig8.json --tier smoke -o -; exit $?) | cat >/dev/null; exit_code=${PIPESTATUS[0]}; (exit $exit_code)'
expect 3 "standard output cannot be written" eval 'piped "$point" run - -o - >/dev/full'
mkdir "$folder/temporary"
expect 3 "standard output cannot be written: Broken pipe; -o - keeps no points" eval '(export TMPDIR=$folder/temporary; piped "$point" run - -o -) | :; exit_code=${PIPESTATUS[0]}; (exit $exit_code)'
rmdir "$folder/temporary" || failed "run -o - into a closed pipe leaves a temporary folder"
expect 2 "no such file" "$bristle" info nowhere.h5
for command in info check validate run verify export "diff $result" "reference update --reason x"; do
  expect 2 "experiments: " "$bristle" $command experiments
  expect 2 "a folder; give the name of a file in it" "$bristle" $command experiments
done
expect 2 "/dev/null: a device, pipe or socket" "$bristle" info /dev/null
expect 2 "not an HDF5 file" "$bristle" check CMakeLists.txt
expect 0 "(verified)" "$bristle" info "$result"
expect 0 "R_x_norm" "$bristle" info "$result"
expect 1 "claims, corrected (polar): 5 supported, 0 refuted, 2 undecided" "$bristle" check --claims-only "$result"
expect 1 "not every claim is supported: exit code 1; --report-only" "$bristle" check --claims-only "$result"
expect 0 "refuted" "$bristle" check --claims-only --report-only "$result"

# A new experiment is valid at once, runs in seconds, with and without paper.json beside it, and replaces nothing.
program=$(realpath "$bristle")
in_folder() { (cd "$1" && shift && "$@"); }
mkdir -p "$folder/alone" "$folder/project/experiments"
cp experiments/paper.json "$folder/project/experiments"
expect 0 "mine.json: written" in_folder "$folder/alone" "$program" new mine
expect 0 "experiments/mine.json: written; compute it with \`$program run experiments/mine.json\`" \
  in_folder "$folder/project" "$program" new mine.json
expect 2 "experiments/mine.json: exists" in_folder "$folder/project" "$program" new mine
expect 0 "points, V0_m_per_s" in_folder "$folder/project" sh -c "'$program' new brush --si && '$program' validate experiments/brush.json"
expect 0 "dimensionless at V0_m_per_s = 30: k_r = 2.09515" in_folder "$folder/project" "$program" validate experiments/brush.json
brush=(in_folder "$folder/project" "$program" run experiments/brush.json --force --set /sweep=null --set /orientation/rtol=0.05)
expect 0 "brush.h5: unreachable at the only point: the brush carries at most 1.82 N per bristle (gap 0.17 mm); you asked for 1e+03 N" "${brush[@]}" --set /si/R_n_N=1000
# A file without a name of its own does not replace the result of the file that it extends.
echo '{"extends": "brush.json", "si": {"R_n_N": 0.5}}' >"$folder/project/experiments/child.json"
expect 2 "child.json: /name: is missing; with the inherited name brush the result would replace another experiment's" \
  in_folder "$folder/project" "$program" run experiments/child.json
expect 0 "child.json: valid" in_folder "$folder/project" "$program" validate experiments/child.json
expect 0 "did not leave the slab within 1000 evaluations of the equations; raise /integrator/max_evaluations" \
  "${brush[@]}" --set /integrator/max_evaluations=1000
expect 0 "raise /integrator/max_evaluations_per_point" "${brush[@]}" --set /integrator/max_evaluations_per_point=1000
expect 2 "--set /model/k_r=3: /model/k_r: has no effect" "${brush[@]}" --set /model/k_r=3
for name in . .. .hidden; do
  expect 2 "new: NAME \"$name\" is not allowed: an experiment is a file" in_folder "$folder/project" "$program" new $name
done
expect 2 'NAME "-x" is not allowed' in_folder "$folder/project" "$program" new -- -x
expect 2 'NAME "a/b" is not allowed' in_folder "$folder/project" "$program" new a/b
for place in alone/mine.json project/experiments/mine.json; do
  expect 0 "10 points" "$bristle" validate "$folder/$place"
  expect 0 "points: 10 ok" timeout 60 "$bristle" run "$folder/$place" -o "$folder/${place%%/*}.h5"
done
# Progress on a terminal names the experiment and the stage.
if script -qec true /dev/null >/dev/null 2>&1; then
  expect 0 "mine: computing 10/10 points" script -qec "$bristle run $folder/alone/mine.json --force -o $folder/alone.h5" /dev/null
  expect 0 "mine: writing $folder/alone.h5" script -qec "$bristle run $folder/alone/mine.json --force -o $folder/alone.h5" /dev/null
  expect 0 "fig4: evaluating the checks" script -qec "$bristle run experiments/fig4.json --tier smoke --force -o $folder/f.h5" /dev/null
else
  echo "no pseudo-terminal here (/dev/pts): progress on a terminal is not tested"
fi
grep -q '"extends": "paper.json"' "$folder/project/experiments/mine.json" || failed "the new experiment does not extend paper.json"
expect 0 "the same, bit for bit" "$bristle" diff "$folder/alone.h5" "$folder/project.h5"

quick=(experiments/paper.json -o "$folder/r.h5" --set /load='{"z_0":0.5,"R_n":null}'
  --set /orientation='{"sampling":"list","theta_0_deg":[10,100]}')
expect 0 "points: 1 ok" "$bristle" run "${quick[@]}"
expect 0 "is up to date" "$bristle" run "${quick[@]}"
expect 0 "points: 1 ok" "$bristle" run "${quick[@]}" --force
"$bristle" run "${quick[@]}" --force 2>&1 | grep -qE '^\w+: computing 1/1 points' || failed "progress: not NAME: computing"
expect 0 "points: 1 ok" "$bristle" run "${quick[@]}" --set /model/k_r=11
expect 0 "the experiment has no checks" "$bristle" check --claims-only "$folder/r.h5"

# A result of another layout is not up to date: it is written again from the journal, without computing.
"$(scripts/find-python)" -c 'import h5py, sys
h5py.File(sys.argv[1], "a").attrs.modify("schema_version", b"bristle-result/1")' "$folder/r.h5"
expect 2 "schema version bristle-result/1, but this program reads bristle-result/2 only" "$bristle" info "$folder/r.h5"
expect 0 "1 computed before" "$bristle" run "${quick[@]}" --set /model/k_r=11
expect 0 "schema bristle-result/2" "$bristle" info "$folder/r.h5"

# A point that cannot be computed becomes a status with a message, and costs no other point.
part=(experiments/paper.json --set '/load={"z_0":0.05,"R_n":null,"path":null}' --set /model/beta=50
  --set '/orientation={"sampling":"list","theta_0_deg":[10,100]}' --set '/sweep={"lambda_z":{"values":[0.001,0.05]}}')
f=$folder/failing
expect 0 "1 ok, 1 failed" "$bristle" run "${part[@]}" -o "$f.h5"
expect 0 "lambda_z = 0.05: no static equilibrium" "$bristle" run "${part[@]}" -o "$f.h5" --force
rm "$f.h5"
expect 0 "2 computed before" "$bristle" run "${part[@]}" -o "$f.h5"
expect 0 "point_1" "$bristle" info "$f.h5"
sharded=$folder/shards/failing.h5
expect 0 "1 ok" "$bristle" run "${part[@]}" --shard 1/2 -o "$sharded"
expect 3 "no point could be computed; lambda_z = 0.05: no static equilibrium" \
  "$bristle" run "${part[@]}" --shard 2/2 -o "$sharded"
expect 0 "1 ok, 1 failed; 2 computed before" "$bristle" run "${part[@]}" --complete -o "$sharded"
expect 0 "no static equilibrium of the bristle" "$bristle" info "$sharded"
expect 0 "the same, bit for bit" "$bristle" diff "$f.h5" "$sharded"

# validate names what an si block leaves as it is.
si='/si={"m_kg":1e-4,"r0_m":0.017,"V0_m_per_s":10,"E_Pa":1e8,"nu":0.4,"R_m":0.001,"k_r_over_k_phi":10}'
expect 0 "the same for any material: tau_f = 30000, R_c = 0.0588235, V_s = 0.01, alpha = 1, beta = 1" \
  "$bristle" validate experiments/paper.json --set "$si"

# A check that names a variable or an axis that the result will not have is reported before anything is computed.
check='[{"claim":"1","statement":"s","predicate":"trend","variable":"gama_1","along":"k_r","is":"at_most","threshold":1}]'
expect 2 'did you mean gamma_1?' "$bristle" validate experiments/fig4.json --set "/checks=$check"
expect 2 '/checks/0/along: "k_r" is not in the result' \
  "$bristle" run "${quick[@]}" --set "/checks=${check/gama/gamma}"

# Full disk: a message, an exit code, no temporary file, and the previous result unchanged.
limited() { (trap '' XFSZ; ulimit -f 16; "$@"); }
before=$(sha256sum "$folder/r.h5")
expect 3 "File too large" limited "$bristle" run "${quick[@]}" --force
[ ! -e "$folder/r.h5.partial" ] || failed "a partial file was left"
[ "$before" = "$(sha256sum "$folder/r.h5")" ] || failed "the result changed"

# Few file descriptors: whatever is the first that is missing, the message says so, and no journal loses points. (The sanitizer of
# undefined behaviour needs a descriptor itself to look at an object, and fails without one.)
fewest=4
grep -q __ubsan_ "$bristle" && fewest=9
few() { (ulimit -n "$1"; shift; "$@") 2>&1; }
"$bristle" run "${quick[@]/%r.h5/few.h5}" --quiet --set /model/k_r=11.02
first=$(head -n 1 "$folder/few.h5.journal")
for n in $(seq $fewest 8); do
  for command in "info $result" "export $result -o $folder/few.csv" "diff $result $result" "validate experiments/fig4.json" \
    "check $result --claims-only --report-only" "run ${quick[*]/%r.h5/few.h5} --set /model/k_r=11.02" \
    "run ${quick[*]/%r.h5/few.h5} --set /model/k_r=11.03"; do
    output=$(few $n "$bristle" $command)
    code=$?
    [ $code = 0 ] || [ $code = 127 ] || { [ $code = 3 ] && grep -q "Too many open files; raise .* .ulimit -n" <<<"$output" &&
      ! grep -qE "damaged|is the disk full|choose another" <<<"$output"; } || failed "$n descriptors: $command: $code $output"
  done
  grep -qF "$first" "$folder/few.h5.journal" || failed "$n descriptors: the journal lost its points"
done

# A small stack.
for size in 64 128 256 1024; do
  for engine in fast reference; do
    small_stack() (ulimit -s $size; "$@")
    expect 0 "1 ok" small_stack "$bristle" run "${quick[@]}" --force --set /integrator/engine=$engine
  done
  expect 0 "verified" small_stack "$bristle" info "$result"
done

# A file whose reading fails.
expect 3 "/proc/self/mem: cannot be read: Input/output error" "$bristle" validate /proc/self/mem

# A result without permission to read it.
chmod 755 "$folder"
cp "$result" "$folder/secret.h5" && chmod 000 "$folder/secret.h5"
as_user=()
[ "$(id -u)" = 0 ] && as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
expect 2 "secret.h5: cannot be read: Permission denied" "${as_user[@]}" "$bristle" info "$folder/secret.h5"

# Standard output that cannot be written is an error of every command.
full() { "$@" >/dev/full; }
expect 3 "standard output cannot be written" full "$bristle" --help
expect 3 "No space left" full "$bristle" validate experiments/fig4.json
expect 3 "" full "$bristle" run "${quick[@]}" --set /model/k_r=11
expect 3 "" full "$bristle" info "$result"
expect 3 "" full "$bristle" check --claims-only --report-only "$result"
expect 3 "" full "$bristle" diff "$result" "$result"

# Fewer threads than asked for, if there is no memory for their stacks. (A sanitizer needs more memory than this.)
small() { (ulimit -v 500000; "$@"); }
if small "$bristle" --version >/dev/null 2>&1; then
  expect 0 "threads could be started" small "$bristle" run "${quick[@]}" --set /model/k_r=11 --force --threads 1000
fi

# Numbers changed by hand are detected.
cp "$result" "$folder/tampered.h5"
offset=$(grep -obUaP '\x00\x00\x00\x00\x00\x00\x59\x40' "$folder/tampered.h5" | head -n 1 | cut -d: -f1)  # k_r = 100
printf '\x01' | dd of="$folder/tampered.h5" bs=1 seek="$offset" conv=notrunc status=none
expect 1 "DOES NOT MATCH" "$bristle" info "$folder/tampered.h5"
for damaged in check "check --claims-only" "check --json" "diff $result" "reference update --reason x"; do
  expect 2 "tampered.h5: damaged: payload_sha256 DOES NOT MATCH the numbers" "$bristle" $damaged "$folder/tampered.h5"
done

# Inputs that may never end, and outputs that are something else.
mkfifo "$folder/pipe"
expect 2 "pipe: cannot be read: a device, pipe or socket" "$bristle" validate "$folder/pipe"
expect 2 "/dev/zero: cannot be read: a device, pipe or socket" "$bristle" validate /dev/zero
expect 2 "pipe: is a device, pipe or socket" "$bristle" run experiments/paper.json -o "$folder/pipe"
cp experiments/paper.json "$folder/mine.json"
expect 2 "mine.json: is not a result of bristle" "$bristle" run "$folder/mine.json" -o "$folder/mine.json"
expect 2 "mine.json: is not a result of bristle" "$bristle" run experiments/fig4.json --complete -o "$folder/mine.json"
expect 2 "mine.json: is not a matrix of assumptions" "$bristle" assumptions -o "$folder/mine.json"
expect 2 "mine.json: is not an archive of bristle" "$bristle" archive -o "$folder/mine.json"
cmp -s experiments/paper.json "$folder/mine.json" || failed "an experiment was replaced"

# Comparison of two results: equal bits, different numbers, invalid tolerances.
"$bristle" run "${quick[@]/%r.h5/q.h5}" --quiet --set /model/k_r=11.01
expect 0 "the same, bit for bit" "$bristle" diff "$folder/r.h5" "$folder/r.h5"
expect 1 "only in $result" "$bristle" diff "$result" "$folder/r.h5"
expect 1 "R_x_norm" "$bristle" diff "$folder/r.h5" "$folder/q.h5"
expect 0 "within the tolerances" "$bristle" diff "$folder/r.h5" "$folder/q.h5" --rtol 1 --atol 0.01
expect 2 "--rtol -1" "$bristle" diff "$folder/r.h5" "$folder/r.h5" --rtol -1
side_by_side() { "$bristle" diff "$folder/r.h5" "$folder/q.h5" --only "$@"; }
expect 1 "B - A" side_by_side R_x_norm
expect 1 "r.h5, B: $folder/q.h5: 1 of 2 values differ" side_by_side R_x_norm,phase
expect 0 "0 of 1 values differ by more than the tolerance" side_by_side R_x_norm --rtol 1
expect 2 "r.h5: --only R_x_nrm: there is no such variable (did you mean R_x_norm?)" side_by_side R_x_nrm
expect 2 "allowed: results with the same axes" "$bristle" diff "$result" "$folder/r.h5" --only R_x_norm
expect 0 "bending = polar, k_r = 5, k_theta = 0.3 " "$bristle" diff "$result" "$result" --only R_x_norm
"$bristle" run experiments/fig4.json --tier smoke --quiet --set '/sweep/k_r={"values":[5,6]}' --set '/sweep/bending={"values":["rod"]}' \
  --set /checks=null -o "$folder/some.h5"
expect 1 "values differ; 42 points are in $result alone; 3 points are in $folder/some.h5 alone" \
  "$bristle" diff "$result" "$folder/some.h5" --only R_x_norm

# A reference in a repository of its own, made from the result as if a clean commit had computed it.
reference=$folder/repository/reference
git init -q "$folder/repository"
cp "$result" "$folder/clean.h5"
of_a_clean_commit() {
  "$(scripts/find-python)" -c 'import h5py, numpy, sys
provenance = h5py.File(sys.argv[1], "r+")["provenance"].attrs
for name in "commit", "points_commits": provenance[name] = numpy.bytes_("0123abc")' "$1"
}
of_a_clean_commit "$folder/clean.h5"
expect 1 "no such reference" "$bristle" check --report-only "$folder/clean.h5" --reference "$reference"
expect 2 "--reason" "$bristle" reference update "$folder/clean.h5" --reference "$reference"
expect 2 "--reason" "$bristle" reference update "$folder/clean.h5" --reference "$reference" --reason ""
expect 0 "new reference" "$bristle" reference update "$folder/clean.h5" --reference "$reference" --reason "first"
expect 0 "unchanged" "$bristle" reference update "$folder/clean.h5" --reference "$reference" --reason "again"
expect 0 "45 points: the same, bit for bit" "$bristle" check --report-only "$result" --reference "$reference"
expect 1 "45 points: the same, bit for bit" "$bristle" check "$result" --reference "$reference"
expect 0 '"failed": false' "$bristle" check --json --report-only "$result" --reference "$reference"
expect 1 ': no such reference; --claims-only skips the comparison"' "$bristle" check --json --report-only "$result" --reference "$folder/none"
expect 1 '"deviation": null' "$bristle" check --json --report-only "$result" --reference "$folder/none"
sed -i '0,/"verdict":"refuted"/s//"verdict":"supported"/' "$reference/fig4.json"
expect 1 "refuted, was supported" "$bristle" check --report-only "$result" --reference "$reference"
git -C "$folder/repository" add . && touch "$folder/repository/work"
expect 2 "commit or stash first" \
  "$bristle" reference update "$folder/clean.h5" --reference "$reference" --reason "the verdict was edited"
rm "$folder/repository/work"
expect 0 "refuted, was supported" \
  "$bristle" reference update "$folder/clean.h5" --reference "$reference" --reason "the verdict was edited"

# Outside the domain of the formulas of lift-off their variables are NaN, which a reference allows.
git -C "$folder/repository" add . && git -C "$folder/repository" -c user.name=n -c user.email=e commit -qm all
echo '{"extends": "paper.json", "name": "high", "title": "A gap of more than 1", "load": {"R_n": null, "z_0": 1.001},
  "model": {"phi_0_deg": 89.9}, "tiers": {"smoke": {"model": {"k_r": 20}}}}' >"$folder/high.json"
cp experiments/paper.json "$folder/"
"$bristle" run "$folder/high.json" --tier smoke --quiet -o "$folder/high.h5"
of_a_clean_commit "$folder/high.h5"
expect 0 "new reference" "$bristle" reference update "$folder/high.h5" --reference "$reference" --reason "high"

# A deviation is reported with the command that computes only its point, with the same bits.
sed -i '/"R_x_norm"/,/"tolerance"/ s/"values": \[\[[0-9.]*,/"values": [[0.1,/' "$reference/fig4.json"
expect 1 "bending = polar, k_r = 5, k_theta = 0.3: " "$bristle" check --report-only "$result" --reference "$reference"
expect 1 " against 0.1  FAILED" "$bristle" check --report-only "$result" --reference "$reference"
expect 1 '"place": "bending = polar, k_r = 5, k_theta = 0.3"' "$bristle" check --json --report-only "$result" --reference "$reference"
replay=$("$bristle" check "$result" --reference "$reference" | grep -A 1 "^To compute bending = polar, k_r = 5, k_theta = 0.3" | tail -n 1)
replay=${replay/build\/bristle/$bristle}
eval "${replay/results\/replay.h5/$folder/replay.h5 --quiet}"
expect 0 "" "$(scripts/find-python)" -c 'import h5py, sys
one, all = (h5py.File(name, "r") for name in sys.argv[1:])
names = [n for n in one if isinstance(one[n], h5py.Dataset) and one[n].shape == (1, 1, 1)]
assert len(names) > 20
for n in names: assert one[n][0, 0, 0].tobytes() == all[n][0, 0, 0].tobytes(), n' "$folder/replay.h5" "$result"
sed -i 's/"values": \[\[0.1,/"values": [["x",/' "$reference/fig4.json"
expect 2 "fig4.json: /variables/R_x_norm/values/0/0: " "$bristle" check "$result" --reference "$reference"

# A design says first whether there is anything to gain; `info` has what it found, in lines.
cp experiments/paper.json "$folder"
cat >"$folder/weak.json" <<EOF
{"extends": "paper.json", "name": "weak", "model": {"friction": "coulomb", "mu_c": 0.2}, "load": {"R_n": 1},
 "orientation": {"sampling": "list", "theta_0_deg": [20, 80, 150]},
 "design": {"variables": {"k_r": [5, 40]}, "objective": {"minimise": "R_x"}, "budget": 2}}
EOF
expect 0 "there is nothing to control" "$bristle" design "$folder/weak.json" -o "$folder/weak.h5"
"$bristle" info "$folder/weak.h5" >"$folder/log"
grep -q "^recommended, " "$folder/log" || failed "info does not say what the design found"

# An interrupted run reports the interruption and leaves the previous result unchanged.
before=$(sha256sum "$result")
"$bristle" run experiments/fig4.json -o "$result" --force 2>"$folder/log" &
sleep 1
kill -INT $!
wait $!
[ $? = 130 ] || failed "exit code after an interrupt"
grep -q "interrupted" "$folder/log" || failed "message after an interrupt"
[ "$before" = "$(sha256sum "$result")" ] || failed "the result changed"
exit $((failures > 0))
