sunlit_bench(camera LIBRARIES sunlit_image)
