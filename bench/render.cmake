sunlit_bench(render LIBRARIES sunlit_render sunlit_light sunlit_scene sunlit_sky sunlit_image TBB::tbb)
if(TARGET bench_render)
  target_include_directories(bench_render PRIVATE ${PROJECT_SOURCE_DIR}/src)  # its stages, one by one
endif()
