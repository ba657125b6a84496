sunlit_bench(lenses LIBRARIES sunlit_render sunlit_scene sunlit_image)
if(TARGET bench_lenses)
  target_include_directories(bench_lenses PRIVATE ${PROJECT_SOURCE_DIR}/test)
endif()
