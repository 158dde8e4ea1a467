# Writes nereid_commit.hpp with the commit that is being built; runs at every build, so that it is
# never the one of the last configure. -DSOURCE=<repository> -DHEADER=<file>
# "-dirty" speaks of the code only: results or notes lying about do not change a program.

set(commit "unknown")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse HEAD WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE failed
                  OUTPUT_VARIABLE found ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed EQUAL 0)
    set(commit "${found}")
    execute_process(COMMAND ${GIT} status --porcelain -- lib drivers cmake CMakeLists.txt
                    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND commit "-dirty")
    endif()
  endif()
endif()

set(text "#pragma once\n#define NEREID_COMMIT \"${commit}\"\n")
set(old "")
if(EXISTS "${HEADER}")
  file(READ "${HEADER}" old)
endif()
if(NOT old STREQUAL text)   # an unchanged file keeps its time: nothing is compiled again
  file(WRITE "${HEADER}" "${text}")
endif()
