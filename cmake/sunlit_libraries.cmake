# Libraries that come in several versions, or with CMake files of theirs that do not fit all systems.

# TBB::tbb, of oneTBB 2021 or of TBB 2020, whose packages may bring no CMake files.
find_package(TBB QUIET)
if(NOT TARGET TBB::tbb)
  find_library(TBB_LIBRARY tbb REQUIRED)
  add_library(TBB::tbb UNKNOWN IMPORTED)
  set_target_properties(TBB::tbb PROPERTIES IMPORTED_LOCATION ${TBB_LIBRARY})
endif()

# embree, and SUNLIT_EMBREE, 3 or 4. Packages of 3.8 may bring no CMake files, and its own name no target.
find_package(embree 3 QUIET)
find_library(EMBREE3_LIBRARY embree3 HINTS ${EMBREE_ROOT_DIR}/lib)
set(SUNLIT_EMBREE 3)
if(NOT TARGET embree AND EMBREE3_LIBRARY)
  add_library(embree UNKNOWN IMPORTED)
  set_target_properties(embree PROPERTIES IMPORTED_LOCATION ${EMBREE3_LIBRARY})
elseif(NOT TARGET embree)
  find_package(embree 4 REQUIRED)
  set(SUNLIT_EMBREE 4)
endif()

# Whether OpenCV has SIFT among what it always has: from 4.4 on.
set(SUNLIT_SIFT ON)
if(OpenCV_VERSION VERSION_LESS 4.4)
  set(SUNLIT_SIFT OFF)
  message(STATUS "OpenCV is ${OpenCV_VERSION}, and has no SIFT before 4.4: sunlit will have none, and tests that compare by it are left out")
endif()

# assimp::assimp. That of Assimp 5.0 names a folder of headers that is elsewhere.
find_package(assimp REQUIRED)
find_path(ASSIMP_INCLUDE_DIR assimp/scene.h REQUIRED)
set_target_properties(assimp::assimp PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${ASSIMP_INCLUDE_DIR})

# Headers of urdfdom, which from 4 on are in folders of their own.
find_path(URDF_MODEL_INCLUDE_DIR urdf_model/model.h PATH_SUFFIXES urdfdom_headers urdfdom REQUIRED)
find_path(URDF_PARSER_INCLUDE_DIR urdf_parser/urdf_parser.h PATH_SUFFIXES urdfdom REQUIRED)

# SUNLIT_SDFORMAT, the target of libsdformat, and SUNLIT_SDFORMAT_VERSION, 12 or 9; empty and 0 where there is neither, and
# then no SDF is read.
set(SUNLIT_SDFORMAT)
set(SUNLIT_SDFORMAT_VERSION 0)
find_package(sdformat12 QUIET)
find_package(sdformat9 9.3 QUIET)
if(sdformat12_FOUND)
  set(SUNLIT_SDFORMAT sdformat12::sdformat12)
  set(SUNLIT_SDFORMAT_VERSION 12)
elseif(sdformat9_FOUND)
  set(SUNLIT_SDFORMAT sdformat9::sdformat9)
  set(SUNLIT_SDFORMAT_VERSION 9)
else()
  message(STATUS "Neither libsdformat 12 nor 9 was found: sunlit will read no SDF")
endif()

# SUNLIT_MESHOPTIMIZER, the target that unpacks glTF's EXT_meshopt_compression; empty where there is none, and then that
# extension is one that is not read.
set(SUNLIT_MESHOPTIMIZER)
find_package(meshoptimizer QUIET)
if(TARGET meshoptimizer::meshoptimizer)
  set(SUNLIT_MESHOPTIMIZER meshoptimizer::meshoptimizer)
else()
  message(STATUS "meshoptimizer was not found: sunlit will read no glTF with EXT_meshopt_compression")
endif()

# SUNLIT_DRACO, the target that unpacks glTF's KHR_draco_mesh_compression; empty where there is none, and then Assimp does, if
# it can. Its CMake files name other targets in each version.
set(SUNLIT_DRACO)
find_library(DRACO_LIBRARY draco)
find_path(DRACO_INCLUDE_DIR draco/compression/decode.h)
if(DRACO_LIBRARY AND DRACO_INCLUDE_DIR)
  set(SUNLIT_DRACO Draco::Draco)
  add_library(Draco::Draco UNKNOWN IMPORTED)
  set_target_properties(Draco::Draco PROPERTIES IMPORTED_LOCATION ${DRACO_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${DRACO_INCLUDE_DIR})
else()
  message(STATUS "Draco was not found: glTF with KHR_draco_mesh_compression is left to Assimp")
endif()
