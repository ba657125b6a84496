# Our SURF, left out by -DSUNLIT_SURF=OFF.
set(sunlit_surf_sources
  features/surf.cpp features/surf_descriptor.cpp features/surf_hessian.cpp features/surf_maxima.cpp
  features/surf_orientation.cpp features/surf_patch.cpp)
