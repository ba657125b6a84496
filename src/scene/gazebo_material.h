/// Gazebo's material scripts: the named colours that come with it, and OGRE .material files.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "sunlit/quantity/photometry.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

struct GazeboLook {
  LinearRgb color;
  float opacity = 1.0f;   ///< 0 … 1
  LinearRgb emissive;     ///< as on a display
  bool pictured = false;  ///< the colour stands for a picture
};

/// Of a material that comes with Gazebo, such as "Gazebo/Grey"; textured ones by their mean colour. None for
/// a name that Gazebo does not have.
std::optional<GazeboLook> gazeboLook(const std::string& name);
Material materialOf(const GazeboLook& look, const std::string& name);

/// What of an OGRE material matters here.
struct ScriptMaterial {
  std::optional<LinearRgb> diffuse;
  std::optional<std::string> texture;  ///< as written in the script
  std::string texture_from;            ///< the file of that script, where one is known
  bool tints = true;                   ///< the diffuse colour multiplies the texture
  bool alpha_rejection = false;        ///< cut out where transparent
  bool blends = false;                 ///< by its opacity
  float opacity = 1.0f;                ///< times that of the texture, 0 … 1
  /// How many times as large as its coordinates say the texture shows, about its middle.
  std::optional<Eigen::Array2f> texture_scale;
  std::optional<LinearRgb> emissive;  ///< as on a display
  std::set<std::string> lost;         ///< keywords of what is not rendered
};

/// A material by its name; none where there is none.
using ScriptOf = std::function<std::optional<ScriptMaterial>(const std::string& name)>;

/// The material `name` in the text of a .material script, from its first technique and pass. None if it is
/// not there. A material that inherits (`material A : B`) takes what it does not set from B: before it in the
/// text, else one that comes with Gazebo, else of `elsewhere`.
std::optional<ScriptMaterial> parseMaterialScript(const std::string& text, const std::string& name,
                                                  const ScriptOf& elsewhere = nullptr);

}  // namespace sunlit::scene
