# Tests of our SURF. Its sources are built a second time without vector clones, with the outer namespace renamed so that
# both fit into one program: the two must agree to the bit.
include(${PROJECT_SOURCE_DIR}/src/evaluate/features/surf_sources.cmake)
set(sunlit_quantity_sources columns.cpp field.cpp range.cpp)  # of the options
list(TRANSFORM sunlit_surf_sources PREPEND ${PROJECT_SOURCE_DIR}/src/evaluate/ OUTPUT_VARIABLE surf_plain_sources)
list(TRANSFORM sunlit_quantity_sources PREPEND ${PROJECT_SOURCE_DIR}/src/quantity/ OUTPUT_VARIABLE quantity_plain_sources)
add_library(sunlit_surf_plain STATIC EXCLUDE_FROM_ALL ${surf_plain_sources} ${quantity_plain_sources})
target_compile_definitions(sunlit_surf_plain PRIVATE SUNLIT_PLAIN_LOOPS sunlit=sunlit_plain)
target_include_directories(sunlit_surf_plain PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
target_link_libraries(sunlit_surf_plain PRIVATE sunlit_flags opencv_features2d opencv_imgproc TBB::tbb)

sunlit_test(evaluate surf LIBRARIES sunlit_surf_plain opencv_features2d opencv_imgproc TBB::tbb)
sunlit_test(evaluate surf_reference LIBRARIES opencv_features2d opencv_imgcodecs opencv_imgproc)
