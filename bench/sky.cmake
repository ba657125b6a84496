sunlit_bench(sky LIBRARIES sunlit_sky)
