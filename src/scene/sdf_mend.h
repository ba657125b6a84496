/// What libsdformat must not see of an SDF file.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// What a height map's texture has for a picture of normals that it does not have.
constexpr const char* kNoNormals = "none";

/// libsdformat checks a world as a simulator needs it: one inertia that no body can have, one name that two
/// links share, and nothing of it is read. A renderer has no use for most of that. Takes out of `sdf`, the
/// root element of `file`, what no camera sees (collisions, inertias, joints, sensors, plugins …), and what
/// cannot be drawn or SDF does not know (elements, types of lights), each kind of these a warning of
/// `builder`; gives names that are missing, reserved or taken a form that libsdformat accepts, which is
/// another warning; and takes versions that it does not know for its newest. Joints to which poses refer, or
/// others that include the file may, become frames.
void mendSdf(tinyxml2::XMLElement& sdf, const std::string& file, SceneBuilder& builder);

/// Whether mendSdf() takes `element`, of a file whose root element is `sdf`, out with all that is in it.
bool isTakenOut(const tinyxml2::XMLElement& element, const tinyxml2::XMLElement& sdf);

/// The same of all files of version 1.4 or newer, as mendSdf() leaves `sdf` where this says so, by the names
/// of elements: whether it takes anything out of one, and whether it may leave `child` in `parent`.
bool isOfKnownChildren(const tinyxml2::XMLElement& sdf);
bool isMendedWithin(const std::string& parent);
bool mayRemain(const std::string& parent, const std::string& child);

/// Leaves the first world of `sdf`, the root element of `file`: each of several has a place of its own. The
/// others are a warning of `builder`.
void keepFirstWorld(tinyxml2::XMLElement& sdf, const std::string& file, SceneBuilder& builder);

}  // namespace sunlit::scene
