#!/bin/bash
# The commit that cmake/version.cmake gives the program, for a small source tree with the project's files for it.
# usage: origin_test.sh CMAKE SOURCE
set -u
cmake=$1 source=$2 bristle=
. "$(dirname "$0")/shell.sh"
cd "$folder" || exit 1
export GIT_CONFIG_GLOBAL=$folder/none GIT_AUTHOR_NAME=n GIT_AUTHOR_EMAIL=e GIT_COMMITTER_NAME=n GIT_COMMITTER_EMAIL=e
printf '@BRISTLE_COMMIT@' >template

# commit_of FOLDER: the commit of a program built there.
commit_of() {
  rm -f made && "$cmake" -DSOURCE_DIR="$1" -DBRISTLE_VERSION=0 -DINPUT="$folder/template" -DOUTPUT="$folder/made" \
    -P "$source/cmake/version.cmake" >messages 2>&1 && cat made
}
# is COMMIT FOLDER WHAT
is() {
  local found
  found=$(commit_of "$2")
  [ "$found" = "$1" ] || failed "$3: \"$found\", not \"$1\": $(cat messages)"
}

mkdir -p own/src own/cmake
cp "$source/.gitattributes" own/ && cp "$source"/cmake/{version.cmake,commit.txt} own/cmake/
touch own/CMakeLists.txt own/src/a.cpp
git init -q own && git -C own add . && git -C own commit -qm m || failed "no repository"
head=$(git -C own rev-parse HEAD)
git init -q other && git -C other commit -q --allow-empty -m m
is "$head" own "a clean checkout"
is "$head" "$folder/other/../own" "a path that is not canonical"
ln -s own linked && is "$head" "$folder/linked" "a symbolic link"

touch own/src/new.cpp
is "$head-dirty" own "a new source file"
git -C own config status.showUntrackedFiles no
is "$head-dirty" own "a new source file where git is told not to show it"
GIT_LITERAL_PATHSPECS=1 is "$head-dirty" own "a new source file and literal path specifications"
rm own/src/new.cpp
for hide in assume-unchanged skip-worktree; do
  git -C own update-index --$hide src/a.cpp && echo change >own/src/a.cpp
  is "$head-dirty" own "a changed file that git was told not to look at: $hide"
  git -C own update-index --no-$hide src/a.cpp && git -C own checkout -q src/a.cpp
  is "$head" own "the same file unchanged"
done
touch own/notes && is "$head" own "a file of which the program is not built"

# What names another repository for git is not the program's.
GIT_DIR=$folder/other/.git is "$head" own "GIT_DIR"
GIT_DIR=$folder/other/.git GIT_WORK_TREE=$folder/own is "$head" own "GIT_DIR and GIT_WORK_TREE"
GIT_INDEX_FILE=$folder/other/.git/index is "$head" own "GIT_INDEX_FILE"
GIT_OBJECT_DIRECTORY=$folder/other/.git/objects is "$head" own "GIT_OBJECT_DIRECTORY"

git -C own worktree add -q "$folder/worktree" HEAD && is "$head" worktree "a work tree"
git -C other -c protocol.file.allow=always submodule --quiet add "$folder/own" sub && git -C other commit -qm sub
is "$head" other/sub "a submodule"

# Tarballs of `git archive`, and trees without git.
mkdir tarball && git -C own archive HEAD | tar x -C tarball
is "$head" tarball "a tarball"
GIT_DIR=$folder/other/.git is "$head" tarball "a tarball and GIT_DIR"
GIT_DIR=$folder/other/.git GIT_WORK_TREE=$folder/tarball is "$head" tarball "a tarball, GIT_DIR and GIT_WORK_TREE"
cp -r tarball other/ && is "$head" other/tarball "a tarball below another repository"
git -C other add . && git -C other commit -qm tarball && is "$head" other/tarball "a tarball in another repository"
cp -r tarball imported && git init -q imported && git -C imported add . && git -C imported commit -qm import
is "$head" imported "a tarball at the top of another repository"
cp -r own copy && rm -rf copy/.git && is unknown copy "a copy without .git"
cp -r copy other/ && is unknown other/copy "a copy below another repository"
rm copy/cmake/commit.txt && is unknown copy "a copy without what a tarball says"
git init -q --bare bare && cp -r copy/. bare/ && is unknown bare "a copy in a bare repository"
mkdir bin && ln -s "$(command -v rm)" "$(command -v cat)" bin/ && PATH=$folder/bin is "$head" tarball "a tarball without git"

# A repository of another user.
export GIT_TEST_ASSUME_DIFFERENT_OWNER=1
is unknown own "a repository that git refuses"
grep -q "safe.directory" messages || failed "git's advice is not shown: $(cat messages)"
unset GIT_TEST_ASSUME_DIFFERENT_OWNER

git -C own rm -qrf --cached . && rm own/.git/index && echo x >own/.git/index
is unknown own "a repository whose index is damaged"
exit $((failures > 0))
