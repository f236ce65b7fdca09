# Fetches the packages of package-lock.json (once) and bundles the page.
#   cmake -D NPM= -D NODE= -D SOURCE= -D WORK= -D PAGE= -D STAMP= -P build_page.cmake
file(MAKE_DIRECTORY ${WORK})
file(REMOVE_RECURSE ${WORK}/src)
file(COPY ${SOURCE}/src ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/tsconfig.json ${SOURCE}/build.mjs
  DESTINATION ${WORK})

file(SHA256 ${WORK}/package-lock.json lock)
set(fetched "")
if(EXISTS ${WORK}/fetched)
  file(READ ${WORK}/fetched fetched)
endif()
if(NOT fetched STREQUAL lock)
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-timeout=20000
    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 180)
  if(NOT result EQUAL 0)
    string(REGEX MATCH "ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH|E401|E403|E503|timeout" offline "${result} ${said}")
    if(offline)
      # No stamp: the next build tries again.
      message("web: without the page: the registry of npm cannot be reached")
      return()
    endif()
    message(FATAL_ERROR "npm ci: ${said}")
  endif()
  file(WRITE ${WORK}/fetched ${lock})
endif()

execute_process(COMMAND ${NODE} build.mjs ${PAGE} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the page was not built")
endif()
file(TOUCH ${STAMP})
