sunlit_bench(mirrors LIBRARIES sunlit_render sunlit_light sunlit_scene sunlit_sky sunlit_image TBB::tbb)
if(TARGET bench_mirrors)
  target_include_directories(bench_mirrors PRIVATE ${PROJECT_SOURCE_DIR}/test)
endif()
