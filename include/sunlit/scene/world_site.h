/// Where on Earth a world says that it lies.
#pragma once

#include <optional>
#include <string>

#include "sunlit/quantity/site.h"
#include "sunlit/scene/load.h"

namespace sunlit::scene {

struct WorldSite {
  Site site;
  std::string place;  ///< where it says so: "<file>:<line>"
};

/// What <spherical_coordinates> of `world`, as load() takes it, say; none where its format knows no such
/// thing, or all are 0, as in worlds that nobody placed. Throws what load() throws of a file that is no XML.
std::optional<WorldSite> siteOf(const std::string& world, const SearchPath& search_path);

}  // namespace sunlit::scene
