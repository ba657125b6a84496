sunlit_bench(light LIBRARIES sunlit_render sunlit_light sunlit_scene sunlit_sky sunlit_image TBB::tbb)
if(TARGET bench_light)
  target_include_directories(bench_light PRIVATE ${PROJECT_SOURCE_DIR}/src)  # its stages, one by one
endif()
