# Writes FOLDER/chart.js: chart.js of FROM/package-lock.json with its licences, fetched by NPM; empty where that cannot be
# had. It never fails the build over the network.
set(out ${FOLDER}/chart.js)
set(modules ${FOLDER}/node_modules)

function(without reason)
  message("comparison page: without charts: ${reason}")
  file(WRITE ${out} "")
endfunction()

file(MAKE_DIRECTORY ${FOLDER})
if(NOT NPM)
  file(WRITE ${out} "")
  return()
endif()
file(COPY ${FROM}/package.json ${FROM}/package-lock.json DESTINATION ${FOLDER})
execute_process(
  COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1
          --fetch-retry-mintimeout=1000 --fetch-timeout=30000
  WORKING_DIRECTORY ${FOLDER} TIMEOUT 180 RESULT_VARIABLE failed OUTPUT_VARIABLE told ERROR_VARIABLE told)
if(failed)
  file(WRITE ${FOLDER}/npm.log "${told}")
  without("npm could not fetch chart.js; see ${FOLDER}/npm.log, and configure again to let it retry")
  return()
endif()

file(READ ${modules}/chart.js/dist/chart.umd.min.js code)
file(READ ${modules}/chart.js/LICENSE.md license)
file(READ ${modules}/@kurkle/color/LICENSE.md color_license)
string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" code "${code}") # a browser's tools would ask for it
string(FIND "${code}${license}${color_license}" "</script" at)
if(NOT at EQUAL -1)
  message(FATAL_ERROR "chart.js holds </script, which would end its element in the page")
endif()
file(WRITE ${out} "/* chart.js\n${license}\n@kurkle/color, which is in it\n${color_license}*/\n${code}")
