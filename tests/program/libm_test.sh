#!/bin/sh
# The program calls no function of the C library whose last bit may differ between machines; it uses
# src/bristle/model/elementary.hpp instead. usage: libm_test.sh NM BRISTLE
set -eu
inexact='sin|cos|tan|asin|acos|atan|atan2|sincos|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|exp10|expm1|log|log2|log10|log1p'
inexact="$inexact|pow|cbrt|hypot|erf|erfc|tgamma|lgamma|j0|j1|jn|y0|y1|yn"
called=$("$1" -D --undefined-only "$2" | sed 's/.* U //; s/@.*//' | grep -xE "($inexact)[fl]?" || true)
if [ -n "$called" ]; then
  echo "functions of the C library that are called:" $called
  exit 1
fi
"$1" -D --undefined-only "$2" | grep -q Sleef_cinz_expd1_u10purec || { echo "no symbols were found"; exit 1; }
