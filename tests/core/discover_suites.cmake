# Writes FILE, which tells CTest of one test per GoogleTest suite in PROGRAM, without the tests that
# the filter EXCLUDED matches. Run after PROGRAM is built.
execute_process(
  COMMAND ${PROGRAM} --gtest_list_tests "--gtest_filter=-${EXCLUDED}"
  OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
# A suite's line begins at the left and ends with a dot, its tests are indented.
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.(  #[^\n]*)?" lines "${list}")
set(content "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "\n|\\.(  #.*)?$" "" suite "${line}")
  string(APPEND content
    "add_test([[${suite}]] [[${PROGRAM}]] [[--gtest_filter=${suite}.*-${EXCLUDED}]])\n")
endforeach()
if(content STREQUAL "")
  message(FATAL_ERROR "${PROGRAM} lists no tests")
endif()
file(WRITE ${FILE} "${content}")
