sunlit_bench(crown LIBRARIES sunlit_light sunlit_scene TBB::tbb)
if(TARGET bench_crown)
  target_include_directories(bench_crown PRIVATE ${PROJECT_SOURCE_DIR}/src)  # the grids of leaves alone
endif()
