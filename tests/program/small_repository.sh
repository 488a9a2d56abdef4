#!/bin/bash
# Makes the current, empty folder a repository with one quick experiment and one assumption, of which an archive is made in
# seconds. usage: small_repository.sh BRISTLE SOURCE
set -eu
bristle=$1 source=$2

git init -q . && mkdir -p experiments/assumptions figures
cp "$source"/{CITATION.cff,LICENSE,LICENSE-DATA} . && cp "$source/experiments/paper.json" experiments/
sed -i "s/^version: .*/version: $("$bristle" --version | cut -d' ' -f2)/" CITATION.cff
cat >experiments/quick.json <<END
{ "extends": "paper.json", "name": "quick", "title": "Quick", "figure": "0", "load": { "R_n": null, "z_0": 0.5 },
  "orientation": { "sampling": "list", "theta_0_deg": [10, 100] }, "record": ["observables", "bristles"],
  "sweep": { "k_r": { "values": [5, 20] }, "friction": { "values": ["nss", "coulomb"] } },
  "checks": [{ "claim": "x", "statement": "R_x is positive", "predicate": "level", "variable": "R_x", "along": "k_r",
    "is": "at_least", "threshold": 0 }] }
END
cat >experiments/assumptions/V_s.json <<END
{ "schema": "bristle-assumption/1", "choice": "V_s", "question": "how large",
  "alternatives": [{ "name": "twice", "description": "twice V_s", "patch": { "model": { "V_s": 0.02 } } }] }
END
printf '/results/\n/figures/\n/dist/\n/*.tar\n' >.gitignore
git add . && git -c user.name=n -c user.email=e commit -qm m
