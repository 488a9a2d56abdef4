# Writes OUTPUT from INPUT with the version and the commit, and only if the content changes. The commit is the one that
# cmake/commit.txt names in a tarball of `git archive`, in whatever repository the tarball is; otherwise the one of the
# repository whose top folder is SOURCE_DIR. An enclosing repository, or one that a variable such as GIT_DIR names, is
# somebody else's.
foreach(name DIR WORK_TREE INDEX_FILE COMMON_DIR OBJECT_DIRECTORY ALTERNATE_OBJECT_DIRECTORIES NAMESPACE PREFIX GRAFT_FILE
    SHALLOW_FILE LITERAL_PATHSPECS GLOB_PATHSPECS NOGLOB_PATHSPECS ICASE_PATHSPECS)
  unset(ENV{GIT_${name}})
endforeach()

# git(OUTPUT ARGUMENT...): sets OUTPUT to what git prints for SOURCE_DIR, git_failed to its exit code, git_message to
# its messages.
macro(git output)
  execute_process(COMMAND git -C ${SOURCE_DIR} ${ARGN} OUTPUT_VARIABLE ${output} OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_VARIABLE git_message ERROR_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE git_failed)
endmacro()

set(BRISTLE_COMMIT "unknown")
set(exported "")
if(EXISTS ${SOURCE_DIR}/cmake/commit.txt)
  file(STRINGS ${SOURCE_DIR}/cmake/commit.txt exported REGEX "^[0-9a-f]+$")
endif()
file(REAL_PATH ${SOURCE_DIR} source)
git(top rev-parse --show-toplevel)
if(exported)
  set(BRISTLE_COMMIT ${exported})
elseif(NOT git_failed)
  file(REAL_PATH "${top}" top)
elseif(EXISTS ${SOURCE_DIR}/.git)
  message("The program will not know its commit, because git does not read this repository: ${git_message} (${git_failed})")
endif()
if(NOT exported AND NOT git_failed AND top STREQUAL source)
  git(commit rev-parse --verify --quiet HEAD)
  # Considers the files from which the program is built. Experiments are stored in every result.
  git(changes status --porcelain --untracked-files=all -- src cmake CMakeLists.txt)
  # Files whose changes git was told not to look at have a small letter or S.
  git(marks ls-files -v -- src cmake CMakeLists.txt)
  if(marks MATCHES "(^|\n)[a-zS] ")
    set(changes "hidden")
  endif()
  if(commit AND NOT git_failed)
    set(BRISTLE_COMMIT ${commit})
    if(changes)
      string(APPEND BRISTLE_COMMIT "-dirty")
    endif()
  endif()
endif()
configure_file(${INPUT} ${OUTPUT} @ONLY)
