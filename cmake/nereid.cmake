# What CMakeLists.txt speaks in: one function per kind of target, one list of compiler settings.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_link_options(-Wl,--build-id=none)         # so that programs differ only if their code does: runs are found again by that
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")   # never -ffast-math: NaN checks and sums rely on IEEE rules

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
find_path(MUPARSER_FOLDER muParser.h REQUIRED)
find_library(MUPARSER_LIBRARY muparser REQUIRED)
add_library(muparser UNKNOWN IMPORTED)
set_target_properties(muparser PROPERTIES IMPORTED_LOCATION ${MUPARSER_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES ${MUPARSER_FOLDER})
find_path(SPECTRA_FOLDER Spectra/SymEigsSolver.h REQUIRED)
add_library(spectra INTERFACE IMPORTED)
set_target_properties(spectra PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SPECTRA_FOLDER})
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)

set(NEREID_VTK "")
if(NEREID_WITH_VTK)
  find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel IOXML)
  if(NOT VTK_FOUND)   # a machine with ParaView's own VTK only
    find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML
                 PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-5.11/vtk)
  endif()
  set(NEREID_VTK ${VTK_LIBRARIES})
endif()

add_library(nereid_settings INTERFACE)
target_compile_options(nereid_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Werror
                       # GCC 12 reports its own AVX-512 intrinsics and strings (GCC bugs 105593, 105651)
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized -Wno-maybe-uninitialized -Wno-restrict>
                       $<$<BOOL:${NEREID_NATIVE}>:-march=native>)
if(NEREID_SANITIZE)
  target_compile_options(nereid_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(nereid_settings INTERFACE -fsanitize=address,undefined)
endif()
if(NEREID_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  target_compile_definitions(nereid_settings INTERFACE NEREID_CHECKED)
endif()
target_include_directories(nereid_settings INTERFACE ${PROJECT_SOURCE_DIR}/lib ${PROJECT_SOURCE_DIR})
target_link_libraries(nereid_settings INTERFACE Eigen3::Eigen Threads::Threads)

# One module: every source in lib/<name>, resting on other modules.
function(nereid_module name)
  cmake_parse_arguments(MODULE "" "" "PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/${name}/*.cpp)
  list(TRANSFORM MODULE_UNPARSED_ARGUMENTS PREPEND nereid::)
  if(sources)
    add_library(nereid_${name} STATIC ${sources})
    target_link_libraries(nereid_${name} PUBLIC nereid_settings ${MODULE_UNPARSED_ARGUMENTS} PRIVATE ${MODULE_PRIVATE})
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
endfunction()

# One program per question, drivers/<name>.cpp; what they share stands in drivers/driver.cpp and probes.cpp.
function(nereid_drivers)
  add_library(nereid_driver STATIC ${PROJECT_SOURCE_DIR}/drivers/driver.cpp
              ${PROJECT_SOURCE_DIR}/drivers/probes.cpp)
  target_link_libraries(nereid_driver PUBLIC nereid::input nereid::output PRIVATE CLI11::CLI11)
  add_custom_target(drivers DEPENDS ${ARGN})
  foreach(name ${ARGN})
    add_executable(${name} ${PROJECT_SOURCE_DIR}/drivers/${name}.cpp)
    target_link_libraries(${name} PRIVATE nereid_driver)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/drivers)
  endforeach()
endfunction()

# The unit tests of one module, tests/<name>/*_test.cpp, as one program <name>_test.
function(nereid_tests name)
  cmake_parse_arguments(TESTS "" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${name}/*_test.cpp)
  if(sources)
    add_executable(${name}_test ${sources})
    target_link_libraries(${name}_test PRIVATE nereid::${name} ${TESTS_LINK} GTest::gtest GTest::gtest_main)
    target_compile_definitions(${name}_test PRIVATE NEREID_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                         PROPERTIES LABELS unit TIMEOUT 300)
  endif()
endfunction()
