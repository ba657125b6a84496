sunlit_bench(transport LIBRARIES sunlit_light sunlit_render sunlit_scene sunlit_sky sunlit_image TBB::tbb)
if(TARGET bench_transport)
  target_include_directories(bench_transport PRIVATE ${PROJECT_SOURCE_DIR}/src)  # its stages, one by one
endif()
