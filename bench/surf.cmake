if(SUNLIT_SURF AND TARGET sunlit_evaluate)
  sunlit_bench(surf LIBRARIES sunlit_evaluate opencv_imgcodecs TBB::tbb)
  target_include_directories(bench_surf PRIVATE ${PROJECT_SOURCE_DIR}/src)
endif()
