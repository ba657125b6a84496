/// What a test needs that not every machine or build has. It says so, and is skipped.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#define SKIP_WITHOUT(folder) \
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here"

/// Where SUNLIT_SDFORMAT_VERSION is defined.
#define SKIP_WITHOUT_SDF()          \
  if (SUNLIT_SDFORMAT_VERSION == 0) \
  GTEST_SKIP() << "needs libsdformat 12 or 9: this build of sunlit reads no SDF"
