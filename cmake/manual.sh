#!/bin/sh
# Writes the manual page from the program's own help. usage: manual.sh BRISTLE VERSION >bristle.1
set -eu
bristle=$1 version=$2
escaped() { sed 's/\\/\\e/g; s/-/\\-/g; s/^\./\\\&./'; }
block() { echo .nf; escaped; echo .fi; }
commands() { "$bristle" "$@" --help | sed '1,/^Subcommands:/d; /^$/,$d' | sed -n 's/^  \([a-z]*\) .*/\1/p'; }
options() { "$bristle" "$@" --help | sed '1,2d; /^Exit codes:/d'; }
cat <<END
.TH BRISTLE 1 "" "bristle $version" "User Commands"
.SH NAME
bristle \\- dry friction of a lattice of elastic bristles under a sliding slab
.SH SYNOPSIS
.B bristle
.I COMMAND
[\\fIOPTION\\fR]... [\\fIARGUMENT\\fR]...
.SH DESCRIPTION
Computes experiments, which are JSON files, into HDF5 files that xarray and netCDF programs open, and compares them with
the claims of Menga, Bottiglione and Carbone, Nonlinear Dynamics (2022).
.SH COMMANDS
END
for command in $(commands); do
  nested=$(commands "$command")
  for name in "$command" $(for n in $nested; do echo "$command:$n"; done); do
    words=$(echo "$name" | tr : ' ')
    echo ".SS bristle $words"
    # shellcheck disable=SC2086
    "$bristle" $words --help | sed -n '1s/.*/&./p' | escaped
    # shellcheck disable=SC2086
    options $words | block
  done
done
cat <<END
.SH EXIT STATUS
END
"$bristle" --help | sed -n 's/^Exit codes: //p' | escaped
cat <<END
.SH FILES
.TP
.I experiments/paper.json
The paper's parameters and all its experiments, beside the program in share/bristle. An experiment that has
"extends": "paper.json" needs no copy of it.
.TP
.I reference/
The stored numbers with which \\fBbristle check\\fR compares, beside the program in share/bristle.
.SH SEE ALSO
The Python package \\fBbristle\\fR computes and draws figures: \\fBpython3 \\-m bristle \\-\\-help\\fR.
END
