# Completion of bristle's commands, options and files for bash. The program's --help names the words.
_bristle() {
  local current=${COMP_WORDS[COMP_CWORD]} command=() word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == [a-z]* && ${#command[@]} -lt 2 && $word != *[./]* ]] && command+=("$word")
  done
  local help
  help=$("${COMP_WORDS[0]}" "${command[@]}" --help 2>/dev/null) ||
    help=$("${COMP_WORDS[0]}" "${command[@]:0:1}" --help 2>/dev/null)
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE -- '^  (-.,)?--[a-z-]+' <<<"$help" | grep -oE -- '--[a-z-]+')" -- "$current")
  elif [[ $help == *Subcommands:* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed '1,/^Subcommands:/d; s/^  \([a-z]*\) .*/\1/; /^ /d; /^$/,$d' <<<"$help")" -- "$current")
  else
    compopt -o default 2>/dev/null
    COMPREPLY=()
  fi
}
complete -F _bristle bristle
