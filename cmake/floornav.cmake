# How every target of the project is made: one library a part, warnings as errors, includes from the root.

add_library(floornav_options INTERFACE)
target_include_directories(floornav_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(floornav_options INTERFACE -Wall -Wextra -Wconversion -Werror -ffp-contract=off)
if(FLOORNAV_SANITIZE)
  target_compile_options(floornav_options INTERFACE -fsanitize=${FLOORNAV_SANITIZE} -fno-omit-frame-pointer
                                                    -fno-sanitize-recover=all)
  target_link_options(floornav_options INTERFACE -fsanitize=${FLOORNAV_SANITIZE})
endif()

# floornav_library(NAME SOURCES ... LINK ...): static library floornav_NAME, alias floornav::NAME. A source *_kernel.cpp
# is compiled once for every instruction set (Highway), which a unity build cannot do.
function(floornav_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(floornav_${name} STATIC ${ARG_SOURCES})
  add_library(floornav::${name} ALIAS floornav_${name})
  list(FILTER ARG_SOURCES INCLUDE REGEX "_kernel\\.cpp$")
  set_source_files_properties(${ARG_SOURCES} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_libraries(floornav_${name} PRIVATE $<BUILD_INTERFACE:floornav_options> PUBLIC ${ARG_LINK})
endfunction()

# floornav_program(NAME SOURCES ... LINK ...): build/bin/floornav-NAME.
function(floornav_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(floornav-${name} ${ARG_SOURCES})
  target_link_libraries(floornav-${name} PRIVATE floornav_options ${ARG_LINK})
endfunction()

# floornav_test(NAME SOURCES ... LINK ... [LABEL slow]): a GoogleTest program of which every test is a CTest test.
function(floornav_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LINK" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1>)  # a test is compiled more often than run
  target_precompile_headers(test_${name} REUSE_FROM floornav_test_headers)
  target_link_libraries(test_${name} PRIVATE floornav_options ${ARG_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT 300 LABELS "${ARG_LABEL}")
endfunction()
