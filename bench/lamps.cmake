sunlit_bench(lamps LIBRARIES sunlit_render sunlit_light sunlit_scene sunlit_sky sunlit_image TBB::tbb)
