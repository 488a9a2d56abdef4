#!/bin/bash
# Builds the program for ARM in FOLDER, runs it under QEMU, and compares its numbers with those of BRISTLE, bit for bit;
# and so BRISTLE itself on an emulated processor without fused multiply-add.
# usage: arm_test.sh SOURCE FOLDER BRISTLE. Exit code 77 (skipped) without cross compiler, QEMU or the packages.
set -u
source=$1 build=$2 bristle=$3
. "$(dirname "$0")/shell.sh"
for program in aarch64-linux-gnu-g++ qemu-aarch64 apt-get; do
  command -v $program >/dev/null || { echo "$program is not installed"; exit 77; }
done
# The packages are fetched once.
if [ ! -e "$build/sysroot/complete" ]; then
  "$source/scripts/arm-sysroot" "$build/sysroot" || { echo "Debian's packages for arm64 cannot be had"; exit 77; }
  touch "$build/sysroot/complete"
fi
"$source/scripts/quietly" cmake -S "$source" --preset aarch64 -B "$build" -G Ninja -DCMAKE_SYSROOT="$build/sysroot/root" &&
  ninja -C "$build" --quiet bristle || exit 1
emulated=(qemu-aarch64 -L "$build/sysroot/root" "$build/bristle")

# compare WHAT OPTION...: an experiment on both.
compare() {
  local what=$1 start=$SECONDS
  shift
  result=$folder/native.h5
  "$bristle" run "$@" --force --quiet -o "$result" || failed "$what: natively"
  expected=$(digest "$result")
  [ -n "$expected" ] || failed "$what: no digest that verifies"
  "${emulated[@]}" run "$@" --force --quiet -o "$folder/emulated.h5" || failed "$what: emulated"
  same "$what ($((SECONDS - start)) s)" "$folder/emulated.h5"
}

cd "$source" || exit 1
gap='/load={"R_n":null,"z_0":0.5}'
some='/orientation={"sampling":"list","theta_0_deg":[5,40,75,110,140,160,175,179]}'
bendings='"bending":{"values":["polar","polar_as_printed","rod"]}'
laws="/sweep={$bendings,\"friction\":{\"values\":[\"nss\",\"coulomb\",\"stribeck\"]},\"k_r\":{\"values\":[3,80]}}"
compare "bendings, friction laws, pinned and reflected bristles" experiments/paper.json --set "$gap" --set "$some" --set "$laws"
pinned=$("$bristle" info "$result" | sed -n 's/^ *pinned_fraction  *(.*)  *\([0-9.]*\) .. \([0-9.]*\).*/\2/p')
[ "$(awk -v p="$pinned" 'BEGIN { print (p > 0) }')" = 1 ] || failed "no bristle is pinned"
own='{"V_R":[0,0.002,0.02,0.2,1,3],"mu":[0,1.1,1.3,0.9,0.7,0.6]}'
compare "values as friction law" experiments/paper.json --set "$gap" --set "$some" --set /model/friction=custom \
  --set "/friction_law=$own"
compare "with Boost.Odeint" experiments/paper.json --set "$gap" --set "$some" --set "/sweep={$bendings}" \
  --set /integrator/engine=reference
compare "on scalars" experiments/paper.json --set "$gap" --set "$some" --set "/sweep={$bendings}" \
  --instruction-set SCALAR
compare "trajectories" experiments/fig2.json --tier smoke --set "$gap" --set "$some"
compare "a load search" experiments/paper.json --set /orientation/rtol=0.02 --set /model/k_r=2
compare "a lattice" experiments/paper.json --set "$gap" --set /model/L_x=1 --set /model/L_y=1 \
  --set /orientation/sampling=lattice --set /orientation/rows=20 --set '/record=["observables","slab_force"]'

if [ "$(uname -m)" = x86_64 ]; then
  emulated=(qemu-x86_64 -cpu Nehalem "$bristle")
  compare "no fused multiply-add" experiments/paper.json --set "$gap" --set "/sweep={$bendings}" \
    --set '/orientation={"sampling":"list","theta_0_deg":[5,75,179]}'
  "$bristle" info "$folder/emulated.h5" | grep -q 'instruction_set  *SCALAR' || failed "vectors on a processor without them"
fi
exit $((failures > 0))
