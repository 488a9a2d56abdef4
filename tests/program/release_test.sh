#!/bin/bash
# scripts/release in a repository of its own. usage: release_test.sh SOURCE
set -u
source=$1
. "$(dirname "$0")/shell.sh"

cd "$folder" && git init -q . && mkdir scripts && cp "$source"/scripts/{release,find-python} scripts/ && cp -r "$source/python" .
cp "$source"/CMakeLists.txt . && echo __pycache__ >.gitignore
cat >CITATION.cff <<END
version: $(sed -n 's/^version: //p' "$source/CITATION.cff")
title: t
abstract: a
keywords: [k]
license: MIT
date-released: 2020-01-01
authors:
  - name: The bristle developers
END
printf '# Changelog\n\n## Unreleased\n\n- new\n\n## 0.0.1 (2020-01-01)\n' >CHANGELOG.md
commit() { git add . && git -c user.name=n -c user.email=e commit -qm m; }
commit
version_of() { case $1 in
  CMakeLists.txt) sed -n 's/^set(BRISTLE_VERSION \([^)]*\)).*/\1/p' "$1" ;;
  CITATION.cff) sed -n 's/^version: //p' "$1" ;;
esac; }
[ "$(version_of CMakeLists.txt)" = "$(version_of CITATION.cff)" ] || failed "CMakeLists.txt and CITATION.cff have different versions"
old=$(version_of CMakeLists.txt)

# refuse TEXT ARGUMENTS...: scripts/release is refused with this text and changes no file.
refuse() {
  local text=$1 output got
  shift
  output=$(scripts/release "$@" 2>&1)
  got=$?
  [ $got = 2 ] && grep -qF -- "$text" <<<"$output" || failed "release $*: exit code $got and: $output"
  git diff --quiet || failed "release $*: files were changed"
}
refuse "CITATION.cff: authors: a release names people" 99.10.0 10.5281/zenodo.12
refuse "CITATION.cff: authors: a release names people" 99.10.0
sed -i 's/^  - name: .*/  - family-names: Somebody\n    given-names: A./' CITATION.cff && commit
refuse "the version is missing"
refuse "the version is missing" ""
for wrong in 1 1.2 v1.2.3 1.2.3.4 01.2.3 1.2.x "1.2.3 " 1.2.3-rc1 "1.2.3;x"; do refuse "is not of the form x.y.z" "$wrong"; done
for wrong in 10.5281 https://doi.org/10.5281/zenodo.1 "10.5281/a b" "10.5281/a&b" 10.52/x; do
  refuse "is not a DOI; write it without https://doi.org/" 99.10.0 "$wrong"
done
[[ $old == *-dev ]] || refuse "is not newer than $old" "$old"
refuse "is not newer than $old" 0.0.9
touch new && refuse "the work tree differs" 99.10.0
rm new
sed -i 's/^## Unreleased$/## 0.0.2 (2020-01-02)/' CHANGELOG.md && commit
refuse "there is no heading '## Unreleased'" 99.10.0
git -c user.name=n -c user.email=e revert --no-edit HEAD >/dev/null

output=$(scripts/release 99.10.0 '10.5281/zenodo.12' 2>&1) || failed "a release: $output"
grep -qF "git tag -a v99.10.0" <<<"$output" || failed "the commands to commit and tag: $output"
today=$(date -u +%Y-%m-%d)
for file in CMakeLists.txt CITATION.cff; do [ "$(version_of $file)" = 99.10.0 ] || failed "$file: $(version_of $file)"; done
archived='identifiers:\n  - type: doi\n    value: 10.5281/zenodo.12\n    description: the archive of this version, with its results'
[ "$(grep -A 4 '^date-released: ' CITATION.cff)" = "$(printf "date-released: %s\n$archived" "$today")" ] ||
  failed "date and DOI: $(cat CITATION.cff)"
[ "$(sed -n 3,7p CHANGELOG.md)" = "$(printf '## Unreleased\n\n## 99.10.0 (%s)\n\n- new' "$today")" ] || failed "CHANGELOG.md: $(cat CHANGELOG.md)"
[ "$(git diff --numstat | awk '{ print $1 + $2 }' | paste -sd ' ')" = "2 8 2" ] || failed "more was changed: $(git diff)"
grep -qF '"version": "99.10.0"' .zenodo.json || failed ".zenodo.json: $(cat .zenodo.json)"
if grep -rnF -- "$old" CMakeLists.txt CITATION.cff | grep -v cff-version; then failed "$old is still there"; fi
sed -i 's/^## 99.10.0/## Unreleased\n\n&/' CHANGELOG.md && commit
refuse "is not newer than 99.10.0" 99.9.1

# A release without a DOI must not keep that of the previous archive; the software keeps its own.
sed -i 's/^license: MIT$/&\ndoi: 10.5281\/zenodo.99/' CITATION.cff && commit
output=$(scripts/release 99.11.0 2>&1) || failed "a second release: $output"
grep -qF "No DOI was given" <<<"$output" && ! grep -qE '^identifiers|zenodo.12' CITATION.cff &&
  grep -qx "doi: 10.5281/zenodo.99" CITATION.cff || failed "without a DOI: $output $(cat CITATION.cff)"
exit $((failures > 0))
