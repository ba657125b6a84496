# Our SURF, left out by -DSUNLIT_SURF=OFF.
set(sunlit_surf_sources
  surf.cpp surf_descriptor.cpp surf_hessian.cpp surf_maxima.cpp surf_orientation.cpp surf_patch.cpp)
