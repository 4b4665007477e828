# Fails where the archive CORE defines or needs a function that one of the archives APART defines: a program that
# links Pinocchio::core gets nothing of those. NM lists the symbols. Run as a script by ctest.
if(NOT NM OR NM MATCHES "NOTFOUND")
  message("skipped: nm is missing")
  return()
endif()

# The names in an archive whose kind matches: T, D, B, R are defined once, U is needed.
function(symbols_of archive kinds result)
  execute_process(COMMAND ${NM} -P ${archive} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^ \n]+ [${kinds}]" lines "${text}")
  list(TRANSFORM lines REPLACE " .*" "")
  set(${result} ${lines} PARENT_SCOPE)
endfunction()

symbols_of(${CORE} TDBRU core)
foreach(archive ${APART})
  symbols_of(${archive} TDBR apart)
  list(LENGTH apart count)
  if(count LESS 5)
    message(FATAL_ERROR "${count} functions in ${archive}: this test compares nothing")
  endif()
  list(REMOVE_ITEM apart ${core})
  list(LENGTH apart left)
  if(NOT left EQUAL count)
    message(FATAL_ERROR "${CORE} has names of ${archive}")
  endif()
endforeach()
