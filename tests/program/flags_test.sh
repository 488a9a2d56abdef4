#!/bin/bash
# Flags of compiler and linker that change numbers are refused when the build is configured; a program whose arithmetic is
# changed by a library that is loaded before it computes nothing.
# usage: flags_test.sh CMAKE SOURCE CXX BRISTLE
set -u
cmake=$1 source=$2 cxx=$3 bristle=$4
. "$(dirname "$0")/shell.sh"

flags() { "$cmake" "$@" -P "$source/cmake/flags.cmake"; }
for flag in -Ofast -ffast-math -funsafe-math-optimizations -fassociative-math -freciprocal-math -ffinite-math-only \
  -fno-signed-zeros -fsingle-precision-constant -ffp-contract=fast -fexcess-precision=fast -mrecip -mrecip=all,!sqrt \
  -mfpmath=387 -mfpmath=sse,387 -mfpmath=both -mno-sse2 -m32 -mpc64 -mdaz-ftz -fcx-limited-range \
  -ffp-model=fast -ffp-model=aggressive -fdenormal-fp-math=positive-zero -fapprox-func -fno-honor-nans; do
  expect 1 "CMAKE_CXX_FLAGS: $flag changes numbers" flags "-DCMAKE_CXX_FLAGS=-O2 $flag -g"
done
expect 1 "CMAKE_CXX_FLAGS_RELEASE: -Ofast" flags -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-Ofast -DNDEBUG"
expect 1 "CMAKE_CXX_FLAGS_OWN: -Ofast" flags -DCMAKE_BUILD_TYPE=Own -DCMAKE_CXX_FLAGS_OWN=-Ofast
expect 1 "CMAKE_EXE_LINKER_FLAGS: -ffast-math" flags "-DCMAKE_EXE_LINKER_FLAGS=-Wl,-z,now -ffast-math"
expect 1 "CMAKE_EXE_LINKER_FLAGS_RELEASE: -Ofast" flags -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXE_LINKER_FLAGS_RELEASE=-Ofast
expect 1 "BRISTLE_KERNEL_OPTIMISATION: -Ofast" flags -DBRISTLE_KERNEL_OPTIMISATION=-Ofast
for harmless in "" "-O3 -march=native" "-ffp-contract=off -fno-fast-math -frounding-math" "-mfpmath=sse -fno-math-errno" \
  "-g -fsanitize=address,undefined -fno-omit-frame-pointer" "-ffp-model=precise -mrecipe"; do
  expect 0 "" flags "-DCMAKE_CXX_FLAGS=$harmless" "-DCMAKE_EXE_LINKER_FLAGS=$harmless"
done
echo "-O2 -ffast-math" >"$folder/more"
expect 1 "CMAKE_CXX_FLAGS, $folder/more: -ffast-math changes numbers" flags "-DCMAKE_CXX_FLAGS=-g @$folder/more"

# As a person sets them.
expect 1 "CMAKE_CXX_FLAGS: -ffast-math" env CXXFLAGS=-ffast-math "$cmake" -S "$source" -B "$folder/a"
expect 1 "CMAKE_EXE_LINKER_FLAGS: -Ofast" env LDFLAGS=-Ofast "$cmake" -S "$source" -B "$folder/b"
expect 1 "(CXX): -ffast-math" env CXX="c++ -ffast-math" "$cmake" -S "$source" -B "$folder/c"

# Subnormal numbers become zero for the whole process, as by the start-up code of -ffast-math, which compilers from GCC 13 on
# do not put into libraries.
if [ "$(uname -m)" = x86_64 ]; then
  printf '#include <immintrin.h>\n[[gnu::constructor]] static void flush() { _mm_setcsr(_mm_getcsr() | 0x8040); }' |
    "$cxx" -xc++ - -shared -fPIC -o "$folder/flush.so" || failed "no library"
  expect 3 "subnormal numbers become zero" env LD_PRELOAD="$folder/flush.so" "$bristle" run "$source/experiments/fig4.json" \
    --tier smoke -o "$folder/r.h5"
fi
printf '#include <cfenv>\n[[gnu::constructor]] static void up() { std::fesetround(FE_UPWARD); }' |
  "$cxx" -xc++ - -shared -fPIC -o "$folder/up.so" || failed "no library"
changed() { LD_PRELOAD=$folder/up.so "$bristle" "$@"; }
for command in "run --tier smoke -o $folder/r.h5" "run --complete -o $folder/r.h5" validate law; do
  expect 3 "sums are not rounded to the nearest number" changed $command "$source/experiments/fig4.json"
done
expect 3 "nothing was computed" changed assumptions -o "$folder/m.json"
expect 3 "nothing was computed" changed design "$source/experiments/design.json" -o "$folder/d.h5"
expect 3 "nothing was computed" changed verify "$folder/archive.tar" --rerun 1
expect 3 "nothing was computed" changed check "$folder/r.h5"
expect 3 "nothing was computed" changed diff "$folder/r.h5" "$folder/r.h5"
expect 3 "nothing was computed" changed reference update "$folder/r.h5" --reason "none"
[ -z "$(ls "$folder"/r.h5* "$folder"/m.json* "$folder"/d.h5* 2>/dev/null)" ] || failed "something was written"
expect 0 "bristle" changed --version
expect 0 "EXPERIMENT" changed run --help
expect 0 '"$schema"' changed schema
exit $((failures > 0))
