# report.html without its data: src/output/report/page.html with the style, our scripts and dygraphs (libjs-dygraphs) in
# it, as a text of the library. It is put together when the build is configured, and again when one of them changes.
set(report_dir ${PROJECT_SOURCE_DIR}/src/output/report)
find_file(STILLPOINT_DYGRAPHS dygraph.min.js PATHS /usr/share/javascript/dygraphs REQUIRED)

file(READ ${report_dir}/page.css REPORT_STYLE)
file(READ ${STILLPOINT_DYGRAPHS} REPORT_DYGRAPHS)
string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" REPORT_DYGRAPHS "${REPORT_DYGRAPHS}")  # it is not there to be found
file(GLOB report_scripts CONFIGURE_DEPENDS ${report_dir}/*.js)
set(REPORT_SCRIPTS "")
foreach(script IN LISTS report_scripts)
  file(READ ${script} text)
  string(APPEND REPORT_SCRIPTS "${text}\n")
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${report_dir}/page.html ${report_dir}/page.css ${report_scripts} ${STILLPOINT_DYGRAPHS})

configure_file(${report_dir}/page.html ${PROJECT_BINARY_DIR}/report_page.html @ONLY)
file(READ ${PROJECT_BINARY_DIR}/report_page.html REPORT_PAGE)
configure_file(${report_dir}/page_template.cpp.in ${PROJECT_BINARY_DIR}/report_page_template.cpp @ONLY)
list(APPEND STILLPOINT_SOURCES ${PROJECT_BINARY_DIR}/report_page_template.cpp)
set_source_files_properties(${PROJECT_BINARY_DIR}/report_page_template.cpp PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
