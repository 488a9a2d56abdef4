# Writes OUTPUT from INPUT with the version and the commit, and only if the content changes.
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse HEAD
  OUTPUT_VARIABLE BRISTLE_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(BRISTLE_COMMIT "unknown")
else()
  # Considers the files from which the program is built. Experiments are stored in every result.
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain -- src cmake CMakeLists.txt
    OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(changes)
    string(APPEND BRISTLE_COMMIT "-dirty")
  endif()
endif()
configure_file(${INPUT} ${OUTPUT} @ONLY)
