/// The stars of the night sky, ready to shine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sunlit/sky/night.h"

namespace sunlit::ros_interface {

struct StarLight {
  std::shared_ptr<const std::vector<sky::Star>>
      stars;                          ///< brightest first; empty where there is no catalogue
  std::vector<std::string> warnings;  ///< for a person to read
};

/// From the installed catalogue. Throws what astronomy::readStarCatalogue() throws.
StarLight loadStars();

}  // namespace sunlit::ros_interface
