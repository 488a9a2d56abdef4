#compdef bristle
# Completion of bristle's commands, options and files for zsh. The program's --help names the words.
local -a command found
local word help
for word in "${words[@]:1:$((CURRENT - 2))}"; do
  [[ $word == [a-z]* && ${#command} -lt 2 && $word != *[./]* ]] && command+=("$word")
done
help=$("${words[1]}" "${command[@]}" --help 2>/dev/null) ||
  help=$("${words[1]}" "${command[@]:0:1}" --help 2>/dev/null)
if [[ ${words[CURRENT]} == -* ]]; then
  found=(${(f)"$(grep -oE -- '^  (-.,)?--[a-z-]+' <<<"$help" | grep -oE -- '--[a-z-]+')"})
  compadd -- "${found[@]}"
elif [[ $help == *Subcommands:* ]]; then
  found=(${(f)"$(sed '1,/^Subcommands:/d; s/^  \([a-z]*\) .*/\1/; /^ /d; /^$/,$d' <<<"$help")"})
  compadd -- "${found[@]}"
else
  _files
fi
