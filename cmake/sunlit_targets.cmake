# How every library, program and test of this package is made.

# Nobody replaces a function of a library at run time: it calls its own, and inlines them.
set(sunlit_own_calls -fno-semantic-interposition)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 11)
  set(sunlit_own_calls)  # makes no SUNLIT_VECTOR_CLONES then of what other files call
endif()

# Flags that all our targets share.
add_library(sunlit_flags INTERFACE)
target_compile_options(sunlit_flags INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  # One rounding per operation, so that results do not depend on how a compiler fuses them.
  -ffp-contract=off
  # Copies of inline functions belong to who makes them; those of tests, with fewer optimisations, serve no library.
  ${sunlit_own_calls} -fvisibility-inlines-hidden)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  # Nor on how Eigen does, which asks for the instruction by name where this says that there is one; nor on the width of its
  # vectors. What is parsed once would have to come before the header.
  target_compile_options(sunlit_flags INTERFACE
    -U__ARM_FEATURE_FMA "SHELL:-include ${PROJECT_SOURCE_DIR}/src/quantity/eigen_packets.h")
  target_link_libraries(sunlit_flags INTERFACE Eigen3::Eigen)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
# GCC takes an optional vector of Eigen's that is asked first for one that is read before it is set, where all of it is inlined.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(sunlit_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>)
endif()
# GCC 13 and later suspect every reference that a function with a temporary key gives, such as fieldOf(rows, "fx").
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(sunlit_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-dangling-reference>)
endif()
if(SUNLIT_WERROR)
  target_compile_options(sunlit_flags INTERFACE -Werror)
endif()
if(SUNLIT_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "SUNLIT_FUZZ is ON, but the compiler is ${CMAKE_CXX_COMPILER_ID}: it must be Clang, for its libFuzzer")
  endif()
  # What a library does that was built without them is seen where it touches our memory alone. Types behind pointers are left
  # out: those of other libraries are not known.
  set(sunlit_sanitizers -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=vptr,function -fno-sanitize-recover=all)
  target_compile_options(sunlit_flags INTERFACE ${sunlit_sanitizers} -fsanitize=fuzzer-no-link -fno-omit-frame-pointer -g1)
  target_link_options(sunlit_flags INTERFACE ${sunlit_sanitizers})
endif()

# Parsing takes most of the time of compiling: what many files include is parsed once for all libraries and programs, once
# more, with ROS, for those of src/ros, and once for all tests. Not with a compiler cache, which would need settings of its
# own for that.
if(CMAKE_CXX_COMPILER_LAUNCHER AND NOT DEFINED CMAKE_DISABLE_PRECOMPILE_HEADERS)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
set(sunlit_parsed_once <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
  <opencv2/core.hpp> <optional> <stdexcept> <string> <tbb/parallel_for.h> <utility> <vector>)
# sunlit_parse_once(NAME HEADERS <header>... LIBRARIES library...)
# These and what nearly all files include, for targets with REUSE_FROM sunlit_NAME_headers that have the flags of `library`.
function(sunlit_parse_once name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES" ${ARGN})
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${name}_headers.cpp CONTENT "")
  add_library(sunlit_${name}_headers OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/${name}_headers.cpp)
  target_link_libraries(sunlit_${name}_headers PRIVATE ${ARG_LIBRARIES} Eigen3::Eigen opencv_core TBB::tbb)
  target_precompile_headers(sunlit_${name}_headers PRIVATE ${sunlit_parsed_once} ${ARG_HEADERS})
endfunction()
sunlit_parse_once(library LIBRARIES sunlit_flags)
sunlit_parse_once(ros HEADERS <ros/node_handle.h> LIBRARIES sunlit_flags ${catkin_LIBRARIES})
target_include_directories(sunlit_ros_headers PRIVATE ${catkin_INCLUDE_DIRS})
# Programs, too: what is parsed for position-independent code serves no other.
set_target_properties(sunlit_library_headers sunlit_ros_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)

# For the same reason files of one library are compiled several at a time, so that names in their unnamed namespaces differ.
# Not with a compiler cache either: whoever edits one file would compile its neighbours.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  option(SUNLIT_UNITY "Compile files of a library several at a time" OFF)
else()
  option(SUNLIT_UNITY "Compile files of a library several at a time" ON)
endif()
# sunlit_together(TARGET)
# Compiles the files of TARGET several at a time.
function(sunlit_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SUNLIT_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  if(SUNLIT_UNITY AND CMAKE_COMPILER_IS_GNUCXX)
    # What a class hides in its file looks like part of a header where that file is one of several.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# sunlit_parsed(TARGET)
# Takes the headers that are parsed once for where TARGET stands.
function(sunlit_parsed target)
  string(FIND ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src/ros at)
  if(at EQUAL 0)
    target_precompile_headers(${target} REUSE_FROM sunlit_ros_headers)
  else()
    target_precompile_headers(${target} REUSE_FROM sunlit_library_headers)
  endif()
  target_compile_options(${target} PRIVATE -fPIC)
endfunction()

# sunlit_library(MODULE SOURCES file... [PUBLIC library...] [PRIVATE library...])
# The library sunlit_MODULE of src/MODULE, with headers in include/sunlit/MODULE.
function(sunlit_library module)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(sunlit_${module} SHARED ${ARG_SOURCES})
  target_include_directories(sunlit_${module} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(sunlit_${module} PUBLIC Eigen3::Eigen ${ARG_PUBLIC} PRIVATE sunlit_flags ${ARG_PRIVATE})
  target_link_options(sunlit_${module} PRIVATE -Wl,-Bsymbolic-functions)  # no table of what it calls of its own
  sunlit_parsed(sunlit_${module})
  sunlit_together(sunlit_${module})
  install(TARGETS sunlit_${module} LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
endfunction()

# sunlit_program(NAME SOURCES file... [LIBRARIES library...])
# A program that `rosrun sunlit NAME` finds, from build and install space.
function(sunlit_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(sunlit_${name} ${ARG_SOURCES})
  sunlit_parsed(sunlit_${name})
  sunlit_together(sunlit_${name})
  set_target_properties(sunlit_${name} PROPERTIES
    OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  target_link_libraries(sunlit_${name} PRIVATE sunlit_flags ${ARG_LIBRARIES})
  install(TARGETS sunlit_${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

# Test programs are linked by gold where there is one, in a tenth of the time: there are hundreds. And compiled with fewer
# optimisations: they call what computes.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LINK_OPTIONS -fuse-ld=gold)
check_cxx_source_compiles("int main() { return 0; }" SUNLIT_GOLD)
unset(CMAKE_REQUIRED_LINK_OPTIONS)
add_library(sunlit_test_flags INTERFACE)
target_link_libraries(sunlit_test_flags INTERFACE sunlit_flags ${CMAKE_DL_LIBS})  # dladdr(), which C libraries before 2.34 have apart
target_compile_options(sunlit_test_flags INTERFACE $<$<CONFIG:Release>:-O1>)
if(SUNLIT_GOLD)
  target_link_options(sunlit_test_flags INTERFACE -fuse-ld=gold)
endif()
sunlit_parse_once(test HEADERS <gtest/gtest.h> LIBRARIES sunlit_test_flags ${GTEST_LIBRARIES})

# sunlit_test(MODULE NAME [LIBRARIES library...])
# The unit test NAME.cpp of the current folder, run by `run_tests`. SUNLIT_SOURCE_DIR and SUNLIT_SHARED_DIR (real test
# input, which may be absent) are defined for it.
function(sunlit_test module name)
  sunlit_tests(${module} ${name} FILES ${name} ${ARGN})
endfunction()

# sunlit_tests(MODULE NAME FILES name... [LIBRARIES library...])
# Unit tests in one program, which is compiled and linked in a fraction of the time of one each. Not for what changes more
# than its own state, such as the environment or a limit of its process.
function(sunlit_tests module name)
  cmake_parse_arguments(ARG "" "" "FILES;LIBRARIES" ${ARGN})
  list(TRANSFORM ARG_FILES APPEND .cpp)
  catkin_add_gtest(test_${module}_${name} ${ARG_FILES})
  sunlit_together(test_${module}_${name})
  target_compile_definitions(test_${module}_${name} PRIVATE
    SUNLIT_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SUNLIT_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  target_precompile_headers(test_${module}_${name} REUSE_FROM sunlit_test_headers)
  target_include_directories(test_${module}_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(test_${module}_${name} sunlit_test_flags sunlit_${module} ${ARG_LIBRARIES} gtest_main)
endfunction()
