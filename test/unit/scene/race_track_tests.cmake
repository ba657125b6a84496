sunlit_test(scene race_track LIBRARIES sunlit_path)
