/// What libsdformat makes of one file, by the ways that its versions have: sdf_parse_12.cpp, sdf_parse_9.cpp.
#pragma once

#include <tinyxml2.h>

#include <sdf/Types.hh>
#include <string>
#include <vector>

#include "scene/sdf_files.h"

namespace sunlit::scene {

/// Before its number in `sources`, what stands in the place of the address of an included model: no ending
/// that libsdformat takes for a file of its own.
constexpr const char* kSdfToken = "included:";

/// Fills file.root from `document`, which it may change, and what is in it and included. Poses of the file
/// may refer to frames of what it includes. Returns errors of libsdformat, or throws its exceptions.
sdf::Errors loadRoot(tinyxml2::XMLDocument& document, const std::vector<const SdfFile*>& sources,
                     SdfFile& file);

/// Whether loadRoot() made a frame of this name, for an included model or what is in it.
bool standsForIncluded(const std::string& frame);

}  // namespace sunlit::scene
