# Functions for the shell tests. Source it with $bristle set; $folder is a temporary folder, $failures a count.
unset $(git rev-parse --local-env-vars 2>/dev/null)  # set where a hook runs the tests
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# failed WHAT...
failed() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect CODE TEXT COMMAND...: the command ends with this exit code and its output contains the text.
expect() {
  local code=$1 text=$2 output got
  shift 2
  output=$("$@" 2>&1)
  got=$?
  if [ "$got" != "$code" ] || ! grep -qF -- "$text" <<<"$output"; then
    failed "$(printf '%s\n  expected exit code %s and: %s\n  got exit code %s and: %s' "$*" "$code" "$text" "$got" "$output")"
  fi
}

# The payload digest; empty if it does not match the numbers.
digest() { "$bristle" info "$1" | sed -n 's/^payload sha256 \(.*\) (verified)$/\1/p'; }

# same WHAT FILE: the payload of FILE has the digest $expected.
same() {
  if [ "$(digest "$2")" = "$expected" ]; then echo "the same: $1"; return; fi
  failed "$1: $(digest "$2"), not $expected"
  "$bristle" diff "$result" "$2" | head -n 20
}
