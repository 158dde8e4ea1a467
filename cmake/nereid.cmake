# What CMakeLists.txt speaks in: one function per kind of target, one list of compiler settings.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_link_options(-Wl,--build-id=none)         # so that programs differ only if their code does: runs are found again by that
# never -ffast-math: NaN checks and sums rely on IEEE rules; nobody reads the errno of a root, and to set it takes a branch
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG -fno-math-errno")

include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
find_path(SPECTRA_FOLDER Spectra/SymEigsSolver.h REQUIRED)
add_library(spectra INTERFACE IMPORTED)
set_target_properties(spectra PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SPECTRA_FOLDER})
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

set(NEREID_VTK "")
if(NEREID_WITH_VTK)
  find_path(LIBDEFLATE_FOLDER libdeflate.h REQUIRED)
  set(NEREID_VTK ${VTK_LIBRARIES} deflate)
endif()

add_library(nereid_settings INTERFACE)
target_compile_features(nereid_settings INTERFACE cxx_std_20)
target_compile_options(nereid_settings INTERFACE
  "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;$<$<NOT:$<STREQUAL:${NEREID_JOIN},ON>>:-Wshadow>;$<$<BOOL:${NEREID_WERROR}>:-Werror>>"
  # GCC 12 reports its own AVX-512 intrinsics and strings (GCC bugs 105593, 105651)
  "$<$<CXX_COMPILER_ID:GNU>:$<BUILD_INTERFACE:-Wno-uninitialized;-Wno-maybe-uninitialized;-Wno-restrict>>"
  # instructions decide how wide tiles are, so whoever uses the libraries compiles for the same ones
  $<$<BOOL:${NEREID_NATIVE}>:-march=native>)
# GCC 12 copies packs of doubles in halves on AMD processors; the whole pack that is read next then waits for its store
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-mmove-max=256 NEREID_WHOLE_PACKS)
if(NEREID_NATIVE AND NEREID_WHOLE_PACKS)
  target_compile_options(nereid_settings INTERFACE -mmove-max=256 -mstore-max=256)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)   # it takes those of the system for ours
  target_compile_options(nereid_settings INTERFACE "$<BUILD_INTERFACE:-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NEREID_JOIN)   # memory for time
  target_compile_options(nereid_settings INTERFACE "$<BUILD_INTERFACE:--param=ggc-min-heapsize=1000000>")
endif()
if(NEREID_SANITIZE)
  set(sanitizers address,undefined)
  if(NEREID_SANITIZE STREQUAL "thread")
    set(sanitizers thread)
  endif()
  target_compile_options(nereid_settings INTERFACE -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(nereid_settings INTERFACE -fsanitize=${sanitizers})
  target_compile_definitions(nereid_settings INTERFACE NEREID_SANITIZED)
endif()
if(NEREID_COVERAGE)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "NEREID_COVERAGE needs clang++; the compiler is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  # It counts what the source says, whatever is optimised. Two processes of a program may count at once, each into its own file. Threads
  # may lose a count, but none that is the only one.
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/counted.txt CONTENT "src:${PROJECT_SOURCE_DIR}/lib/*\n")
  set(counting -fprofile-instr-generate=${PROJECT_BINARY_DIR}/counts/%2m.profraw)
  target_compile_options(nereid_settings INTERFACE
    "$<BUILD_INTERFACE:${counting};-fcoverage-mapping;-fprofile-list=${PROJECT_BINARY_DIR}/generated/counted.txt>")
  target_link_options(nereid_settings INTERFACE "$<BUILD_INTERFACE:${counting}>")
endif()
if(NEREID_ONE_LANE)
  target_compile_definitions(nereid_settings INTERFACE NEREID_ONE_LANE)
endif()
if(NEREID_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  target_compile_definitions(nereid_settings INTERFACE NEREID_CHECKED)
endif()
target_include_directories(nereid_settings INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib;${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:include;include/nereid>")
target_link_libraries(nereid_settings INTERFACE Eigen3::Eigen Threads::Threads)
set_target_properties(nereid_settings PROPERTIES EXPORT_NAME settings)
install(TARGETS nereid_settings EXPORT nereid)

# Headers that nearly every source includes, read once: a third of the time of a build. A source still includes all it uses:
# scripts/syntax compiles each source by itself and without them.
function(nereid_precompile name)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/generated/${name}.cpp)
  target_link_libraries(${name} PRIVATE nereid_settings)
  target_precompile_headers(${name} PRIVATE <algorithm> <array> <cmath> <cstdint> <cstdio> <functional> <limits> <map> <memory> <optional>
    <set> <span> <string> <string_view> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry> ${ARGN})
endfunction()
nereid_precompile(nereid_precompiled)
nereid_precompile(nereid_precompiled_models <contact/contact.hpp> <dynamics/measure.hpp> <dynamics/model.hpp> <dynamics/probe.hpp>)

# With NEREID_JOIN, fourteen sources of a target are compiled at once: what they instantiate alike is instantiated once. Names in unnamed
# namespaces are therefore unique in a module. What one source calls a variable may be a name of another one: that shadows nothing.
function(nereid_join target)
  if(NOT NEREID_JOIN OR (NEREID_JOIN STREQUAL "TESTS" AND NOT target MATCHES "_test$"))
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 14)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")   # it takes what Eigen does with memory for a fault of ours
    target_compile_options(${target} PRIVATE -Wno-use-after-free)
  endif()
endfunction()

# One module: every source in the folder lib/<path>, resting on other modules. lib/contact/search is nereid::contact_search.
function(nereid_module path)
  cmake_parse_arguments(MODULE "" "" "PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/${path}/*.cpp)
  string(REPLACE "/" "_" name ${path})
  list(TRANSFORM MODULE_UNPARSED_ARGUMENTS REPLACE "/" "_")
  list(TRANSFORM MODULE_UNPARSED_ARGUMENTS PREPEND nereid::)
  # headers that only our own sources see are no business of those who use the libraries
  list(TRANSFORM MODULE_PRIVATE REPLACE "^(spectra|nlohmann_json::nlohmann_json)$" "$<BUILD_INTERFACE:\\1>")
  if(sources)
    add_library(nereid_${name} STATIC ${sources})
    target_link_libraries(nereid_${name} PUBLIC nereid_settings ${MODULE_UNPARSED_ARGUMENTS} PRIVATE ${MODULE_PRIVATE})
    set(precompiled nereid_precompiled)
    if(name MATCHES "^(dynamics|model|input|output)$")   # most of their sources see whole models
      set(precompiled nereid_precompiled_models)
    endif()
    target_precompile_headers(nereid_${name} REUSE_FROM ${precompiled})
    if(NOT path MATCHES "^contact/")   # whose sources name constants of judgement alike
      nereid_join(nereid_${name})
    endif()
    if(name STREQUAL "output")   # what a summary says of the program that wrote it
      string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
      string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" flags)
      set(commit_header ${PROJECT_BINARY_DIR}/generated/nereid_commit.hpp)
      add_custom_target(nereid_commit BYPRODUCTS ${commit_header}
        COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADER=${commit_header}
                -P ${PROJECT_SOURCE_DIR}/lib/output/commit.cmake)
      add_dependencies(nereid_output nereid_commit)
      target_include_directories(nereid_output PRIVATE ${PROJECT_BINARY_DIR}/generated)
      target_compile_definitions(nereid_output PRIVATE
        NEREID_COMPILER="${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
        NEREID_BUILD_TYPE="${CMAKE_BUILD_TYPE}"
        NEREID_FLAGS="${flags}" NEREID_VERSION="${PROJECT_VERSION}"
        $<$<BOOL:${NEREID_NATIVE}>:NEREID_NATIVE>)
    endif()
    if(name STREQUAL "grid" AND NEREID_WITH_VTK)
      target_compile_definitions(nereid_grid PRIVATE NEREID_WITH_VTK)
      vtk_module_autoinit(TARGETS nereid_grid MODULES ${VTK_LIBRARIES})
    endif()
  else()
    add_library(nereid_${name} INTERFACE)
    target_link_libraries(nereid_${name} INTERFACE nereid_settings ${MODULE_UNPARSED_ARGUMENTS})
  endif()
  add_library(nereid::${name} ALIAS nereid_${name})
  set_target_properties(nereid_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS nereid_${name} EXPORT nereid ARCHIVE COMPONENT library)
endfunction()

# What `cmake --install` puts in place for find_package(nereid): libraries, headers below include/nereid, and the package.
function(nereid_package)
  include(CMakePackageConfigHelpers)
  set(folder lib/cmake/nereid)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/lib/ DESTINATION include/nereid COMPONENT library FILES_MATCHING PATTERN "*.hpp")
  install(EXPORT nereid NAMESPACE nereid:: DESTINATION ${folder} FILE nereidTargets.cmake COMPONENT library)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/nereidConfig.cmake.in ${PROJECT_BINARY_DIR}/nereidConfig.cmake
                                INSTALL_DESTINATION ${folder})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/nereidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/nereidConfig.cmake ${PROJECT_BINARY_DIR}/nereidConfigVersion.cmake
                ${PROJECT_SOURCE_DIR}/cmake/dependencies.cmake DESTINATION ${folder} COMPONENT library)
endfunction()

# One program per question, drivers/<name>.cpp; what they share has headers and makes the library.
function(nereid_drivers)
  set(folder ${PROJECT_SOURCE_DIR}/drivers)
  file(GLOB names CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*.cpp)
  file(GLOB shared CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*.hpp)
  list(TRANSFORM shared REPLACE "\\.hpp$" ".cpp")
  list(REMOVE_ITEM names ${shared})
  list(TRANSFORM names REPLACE "\\.cpp$" "")
  list(TRANSFORM shared PREPEND ${folder}/)
  add_library(nereid_driver STATIC ${shared})
  target_link_libraries(nereid_driver PUBLIC nereid::input nereid::output PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json)
  target_precompile_headers(nereid_driver REUSE_FROM nereid_precompiled_models)
  nereid_join(nereid_driver)
  add_custom_target(drivers DEPENDS ${names})
  foreach(name ${names})
    add_executable(${name} ${PROJECT_SOURCE_DIR}/drivers/${name}.cpp)
    target_link_libraries(${name} PRIVATE nereid_driver)
    target_precompile_headers(${name} REUSE_FROM nereid_precompiled_models)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/drivers)
    install(TARGETS ${name} RUNTIME COMPONENT programs)
  endforeach()
endfunction()

# What is tested keeps its optimisation; the tests themselves need little, and a third of their build goes by it. Of inline functions the
# linker takes those of the tests, so tests that compute for long keep as much.
set(NEREID_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)
set(NEREID_TEST_OPTIONS_QUICK ${NEREID_TEST_OPTIONS} $<$<AND:$<CONFIG:Check>,$<CXX_COMPILER_ID:Clang>>:-O0>)

# Programs of the tests of this folder have one thread: tests run side by side, and with one for each core they would wait for each other.
function(nereid_one_thread)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach(test ${tests})
    if(test MATCHES "^(drivers|verify|scripts)[.]")
      set_property(TEST ${test} APPEND PROPERTY ENVIRONMENT NEREID_THREADS=1)
    endif()
  endforeach()
endfunction()

# The unit tests of one module and of those in its folders, tests/<name>/**/*_test.cpp, as one program <name>_test.
function(nereid_tests name)
  cmake_parse_arguments(TESTS "" "" "LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${name}/*_test.cpp)
  if(sources)
    add_executable(${name}_test ${sources})
    target_link_libraries(${name}_test PRIVATE nereid::${name} ${TESTS_LINK} GTest::gtest GTest::gtest_main)
    if(name MATCHES "^(element|contact|dynamics)$")
      target_precompile_headers(${name}_test REUSE_FROM nereid_precompiled_tests)
      target_compile_options(${name}_test PRIVATE ${NEREID_TEST_OPTIONS})
    else()
      target_precompile_headers(${name}_test REUSE_FROM nereid_precompiled_quick_tests)
      target_compile_options(${name}_test PRIVATE ${NEREID_TEST_OPTIONS_QUICK})
    endif()
    nereid_join(${name}_test)
    # clang asks for braces that the standard does not, and knows no pragma that is for GCC alone
    target_compile_options(${name}_test PRIVATE "$<$<CXX_COMPILER_ID:Clang>:-Wno-error=missing-braces;-Wno-error=unknown-pragmas>")
    target_compile_definitions(${name}_test PRIVATE NEREID_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    if(NOT NEREID_TEST_SHARDS)
      gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                           PROPERTIES LABELS unit TIMEOUT 300)
      return()
    endif()
    foreach(shard RANGE 1 ${NEREID_TEST_SHARDS})   # to start a program often takes longer than its tests
      math(EXPR index "${shard} - 1")
      add_test(NAME ${name}.${shard} COMMAND ${name}_test)
      set_tests_properties(${name}.${shard} PROPERTIES LABELS unit TIMEOUT 1200
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=${NEREID_TEST_SHARDS};GTEST_SHARD_INDEX=${index}")
    endforeach()
  endif()
endfunction()
