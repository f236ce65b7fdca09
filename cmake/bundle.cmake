# Fetches the packages of package-lock.json (once) and bundles a program for Node.js or a browser with its build.mjs.
#   cmake -D WHAT= -D NPM= -D NODE= -D SOURCE= -D WORK= -D OUTPUT= -D STAMP= -P bundle.cmake
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
    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 300)
  if(NOT result EQUAL 0)
    string(REGEX MATCH "ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH|E401|E403|E503|timeout" offline "${result} ${said}")
    if(offline)
      # No stamp: the next build tries again.
      message("without ${WHAT}: the registry of npm cannot be reached")
      return()
    endif()
    message(FATAL_ERROR "npm ci: ${said}")
  endif()
  file(WRITE ${WORK}/fetched ${lock})
endif()

execute_process(COMMAND ${NODE} build.mjs ${OUTPUT} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${WHAT} was not built")
endif()
file(TOUCH ${STAMP})
