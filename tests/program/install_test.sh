#!/bin/bash
# Installs into a temporary prefix, and uses the program from an empty folder as a new user would.
# usage: install_test.sh BRISTLE BUILD PYTHON, from the repository's root.
set -u
bristle=$1 build=$(realpath "$2") python=$3
. "$(dirname "$0")/shell.sh"
prefix=$folder/usr empty=$folder/empty
mkdir "$empty"
cmake --install "$build" --prefix "$prefix" --strip >"$folder/log" 2>&1 || failed "cmake --install: $(tail -n 3 "$folder/log")"
installed=$prefix/bin/bristle
in_empty() { (cd "$empty" && env -i PATH="$prefix/bin:/usr/bin:/bin" HOME="$empty" "$@"); }

# The paper's parameters and the references come with the program.
echo '{"extends": "paper.json", "name": "mine", "model": {"k_r": 12}, "orientation": {"rtol": 0.02}}' >"$empty/mine.json"
expect 0 "1 ok" in_empty bristle run mine.json
expect 0 "experiment mine" in_empty bristle info results/mine.h5
expect 0 "fresh.json: written" in_empty bristle new fresh
expect 0 "10 points" in_empty bristle validate fresh.json
expect 0 "39 ok, 4 unreachable, 2 ambiguous" in_empty bristle run "$prefix/share/bristle/experiments/fig4.json" --tier smoke
expect 0 "$prefix/share/bristle/reference/fig4.json: 2835 values at 45 points: the same, bit for bit" \
  in_empty bristle check results/fig4-smoke.h5 --report-only
sed 's/paper.json/papr.json/' "$empty/mine.json" >"$empty/wrong.json"
expect 2 'wrong.json: /extends: "papr.json" does not exist' in_empty bristle run wrong.json

# All experiments of the repository, and none of the user's own.
git ls-files experiments | sort >"$folder/expected" 2>/dev/null
if [ -s "$folder/expected" ]; then
  (cd "$prefix/share/bristle" && find experiments -type f) | sort | diff "$folder/expected" - >"$folder/log" ||
    failed "installed experiments: $(cat "$folder/log")"
fi

# A file beside the experiment has precedence over the one that comes with the program.
sed 's/"k_phi": 1.9/"k_phi": 2.1/' experiments/paper.json >"$empty/paper.json"
cmp -s experiments/paper.json "$empty/paper.json" && failed "paper.json has no k_phi to change"
mv "$empty/results/mine.h5" "$empty/supplied.h5"
expect 0 "1 ok" in_empty bristle run mine.json
expect 1 "z_0" in_empty bristle diff results/mine.h5 supplied.h5
rm "$empty/paper.json"

# The figures, from the installed package.
expect 0 "" in_empty env PYTHONPATH="$prefix/lib/python3/dist-packages" "$python" -m bristle fig4 results/fig4-smoke.h5 -o plots
[ -s "$empty/plots/fig4.pdf" ] || failed "no plots/fig4.pdf"
expect 0 "command/fig4-smoke-curve-R_x_norm.png" in_empty bristle-plot curve results/fig4-smoke.h5 --format png -o command
[ -s "$empty/command/fig4-smoke-curve-R_x_norm.png" ] || failed "bristle-plot: no command/fig4-smoke-curve-R_x_norm.png"
expect 2 "bristle-plot: error: results/none.h5: no such file" in_empty bristle-plot fig4 results/none.h5
expect 0 "('mu_c',)" in_empty env PYTHONPATH="$prefix/lib/python3/dist-packages" "$python" -c \
  'from bristle import run; print(run("paper.json", quiet=True, mu_c=[1], orientation={"rtol": 0.1})["R_x"].dims)'

# pip installs the same package from a checkout, without a network.
checkout=$folder/checkout packages=$prefix/lib/python3/dist-packages
mkdir "$checkout" && cp -r pyproject.toml setup.py CMakeLists.txt README.md python "$checkout"
expect 0 "Successfully installed bristle-" \
  "$python" -m pip install --no-build-isolation --no-index --target "$folder/pip" "$checkout"
modules() { (cd "$1" && find bristle -type f ! -name '*.pyc' | sort); }
[ "$(modules "$packages" | wc -l)" -gt 75 ] && diff <(modules "$packages") <(modules "$folder/pip") >"$folder/log" ||
  failed "pip and make install differ: $(cat "$folder/log")"
expect 0 "RESULT.h5" in_empty env PYTHONPATH="$folder/pip" "$python" -m bristle.report --help
expect 0 "('mu_c',)" in_empty env PYTHONPATH="$folder/pip" "$python" -c \
  'from bristle import run; print(run("paper.json", quiet=True, mu_c=[1], orientation={"rtol": 0.1})["R_x"].dims)'

# The Slurm scripts find the installed program. This sbatch accepts every job.
printf '#!/bin/sh\necho 7\n' >"$prefix/bin/sbatch"
chmod +x "$prefix/bin/sbatch"
expect 0 "mine.json: valid" in_empty "$prefix/share/bristle/slurm/array.sh" mine.json 2
expect 0 "job 7: 2 shards" in_empty "$prefix/share/bristle/slurm/array.sh" mine.json 2
rm "$prefix/bin/sbatch"

# The manual page names each command and option of the help; the completion completes them.
page=$prefix/share/man/man1/bristle.1
commands=$("$installed" --help | sed '1,/^Subcommands:/d; /^$/,$d' | awk '{print $1}')
[ -n "$commands" ] || failed "no commands in the help"
for command in $commands; do
  grep -q "bristle $command" "$page" || failed "bristle.1 lacks the command $command"
  for option in $("$installed" "$command" --help | grep -oE -- '^  (-.,)?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
    sed 's/\\-/-/g' "$page" | grep -q -- "$option" || failed "bristle.1 lacks $command $option"
  done
done
complete() {  # WORD...: what completes the last word
  PATH=$prefix/bin:$PATH bash -c '. "$0"; COMP_WORDS=(bristle "$@"); COMP_CWORD=$#; _bristle; echo "${COMPREPLY[*]}"' \
    "$prefix/share/bash-completion/completions/bristle" "$@"
}
[ "$(complete vali)" = validate ] || failed "completion of vali: $(complete vali)"
[ "$(complete run --ti)" = --tier ] || failed "completion of run --ti: $(complete run --ti)"
[ "$(complete reference up)" = update ] || failed "completion of reference up: $(complete reference up)"
[ "$(complete run mine.json --thr)" = --threads ] || failed "completion after an argument: $(complete run mine.json --thr)"
complete_in_zsh() {  # WORD...: the words among which zsh completes the last one
  PATH=$prefix/bin:$PATH zsh -c 'compadd() { print -r -- "$@" }; words=(bristle "$@"); CURRENT=${#words}; source "$0"' \
    "$prefix/share/zsh/site-functions/_bristle" "$@"
}
if command -v zsh >/dev/null; then
  [[ $(complete_in_zsh "") == *" validate "* ]] || failed "completion in zsh: $(complete_in_zsh "")"
  [[ $(complete_in_zsh run --ti) == *" --tier "* ]] || failed "completion in zsh of run --ti: $(complete_in_zsh run --ti)"
  [[ $(complete_in_zsh reference "") == *update* ]] || failed "completion in zsh of reference: $(complete_in_zsh reference "")"
fi
exit $((failures > 0))
