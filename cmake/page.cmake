# The comparison's page as C strings, in meniscus_compare: web/ and, from npm, its charts.
#
# npm is asked once a build folder (or when web/package-lock.json changes). Where it is missing or cannot fetch, the
# build goes on, and the page has tables and pictures without charts; the next configure lets npm try again.
option(MNS_PAGE "inline chart.js, fetched by npm, into the page that `compare` writes" ON)

set(page_folder ${CMAKE_BINARY_DIR}/web)
set(page_chart ${page_folder}/chart.js)
if(EXISTS ${page_chart})
  file(SIZE ${page_chart} page_chart_size)
  if(page_chart_size EQUAL 0)
    file(REMOVE ${page_chart})
  endif()
endif()

find_program(NPM_PROGRAM npm)
if(NOT MNS_PAGE OR MNS_FUZZ)
  message(STATUS "comparison page: without charts (MNS_PAGE is off)")
elseif(NOT NPM_PROGRAM)
  message(STATUS "comparison page: without charts: npm is missing, which fetches chart.js")
else()
  message(STATUS "comparison page: charts by chart.js, fetched by ${NPM_PROGRAM}")
  set(page_npm ${NPM_PROGRAM})
endif()

add_custom_command(
  OUTPUT ${page_chart}
  COMMAND ${CMAKE_COMMAND} -DNPM=${page_npm} -DFROM=${CMAKE_SOURCE_DIR}/web -DFOLDER=${page_folder}
          -P ${CMAKE_SOURCE_DIR}/cmake/page_chart.cmake
  DEPENDS ${CMAKE_SOURCE_DIR}/web/package-lock.json ${CMAKE_SOURCE_DIR}/cmake/page_chart.cmake
  COMMENT "chart.js for the comparison's page")

add_executable(embed_page cmake/embed_page.c)
set(page_text ${CMAKE_BINARY_DIR}/page_text.c)
set(page_files web/page.html web/page.css web/page.js web/charts.js web/tables.js web/slider.js)
list(TRANSFORM page_files PREPEND ${CMAKE_SOURCE_DIR}/)
add_custom_command(
  OUTPUT ${page_text}
  COMMAND embed_page ${page_text} ${page_files} ${page_chart}
  DEPENDS embed_page ${page_files} ${page_chart}
  COMMENT "embedding web/")
target_sources(meniscus_compare PRIVATE ${page_text})
