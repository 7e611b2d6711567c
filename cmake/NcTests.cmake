# SPDX-License-Identifier: Apache-2.0
# How the tests of a room are compiled, and what CTest runs.

# nc_join_tests(FILES ROOM): replaces the *_test.cpp in the list FILES by sources that hold NC_TESTS_PER_SOURCE of them each (tests/join-tests.sh). Most of
# the time of a build went into headers and templates that the tests of a room have in common. Files with options of their own stay alone, and those
# with the property SKIP_UNITY_BUILD_INCLUSION.
function(nc_join_tests files room)
  if(NOT NC_TESTS_PER_SOURCE GREATER 1)
    return()
  endif()
  set(alone)
  set(joined)
  foreach(source IN LISTS ${files})
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    get_source_file_property(skip ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(source MATCHES "_test\\.cpp$" AND NOT options AND NOT skip)
      list(APPEND joined ${source})
    else()
      list(APPEND alone ${source})
    endif()
  endforeach()
  set(script ${CMAKE_SOURCE_DIR}/tests/join-tests.sh)
  set(number 0)
  while(joined)
    list(SUBLIST joined 0 ${NC_TESTS_PER_SOURCE} some)
    list(REMOVE_ITEM joined ${some})
    math(EXPR number "${number} + 1")
    set(source ${CMAKE_CURRENT_BINARY_DIR}/joined/${room}_${number}.cpp)
    add_custom_command(OUTPUT ${source} DEPENDS ${some} ${script} COMMAND bash ${script} ${source} ${some} VERBATIM)
    set_source_files_properties(${source} PROPERTIES INCLUDE_DIRECTORIES ${CMAKE_CURRENT_SOURCE_DIR}/${room})    # for #include "..."
    list(APPEND alone ${source})
  endwhile()
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/joined)
  set(${files} ${alone} PARENT_SCOPE)
endfunction()

# nc_add_packs(ROOM NUMBER COST): the cases of test_<room> once more, in NUMBER packs. A pack is one process with every NUMBERth case.
function(nc_add_packs room number cost)
  set(packs)
  foreach(pack RANGE 1 ${number})
    math(EXPR index "${pack} - 1")
    string(APPEND packs "add_test(${room}.pack_${pack} \"$<TARGET_FILE:test_${room}>\")\n"
           "set_tests_properties(${room}.pack_${pack} PROPERTIES TIMEOUT 1200 COST ${cost} LABELS ${room} WORKING_DIRECTORY \"${CMAKE_BINARY_DIR}\""
           " ENVIRONMENT \"NC_SANITIZE=${NC_SANITIZE};GTEST_TOTAL_SHARDS=${number};GTEST_SHARD_INDEX=${index}\")\n")
  endforeach()
  set_property(DIRECTORY APPEND_STRING PROPERTY NC_PACKS "${packs}")
endfunction()

# nc_cases_or_packs(): ctest runs one process per case, or, with NC_TEST_PACKS=1 in its environment, the packs. Under a sanitizer a process takes
# longer to start than most cases take.
function(nc_cases_or_packs)
  get_property(packs DIRECTORY PROPERTY NC_PACKS)
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/packs.cmake CONTENT "${packs}")
  get_property(cases DIRECTORY PROPERTY TEST_INCLUDE_FILES)
  set(text "if(\"\$ENV{NC_TEST_PACKS}\" STREQUAL \"1\")\n  include(\"${CMAKE_CURRENT_BINARY_DIR}/packs.cmake\")\nelse()\n")
  foreach(file IN LISTS cases)
    string(APPEND text "  include(\"${file}\")\n")
  endforeach()
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/cases_or_packs.cmake "${text}endif()\n")
  set_property(DIRECTORY PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/cases_or_packs.cmake)
endfunction()
