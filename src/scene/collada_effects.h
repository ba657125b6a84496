/// What effects of COLLADA say that Assimp does not hand on.
#pragma once

#include <map>
#include <set>
#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// By names of materials.
struct ColladaEffects {
  /// How pictures in <transparent> are meant, without their files; not where the alpha of a picture is an
  /// opacity (A_ONE), as Assimp takes it for.
  std::map<std::string, OpacityPicture> transparency;
  std::set<std::string> without_diffuse;  ///< for whose colour Assimp has a grey of its own
  /// Names by ids, of those whose effect is not there, or that name none.
  std::map<std::string, std::string> without_effect;
  std::set<std::string> set_apart;  ///< give parameters of their effects other values by <setparam>
};
/// `text` as withParameters() gives it.
ColladaEffects effectsOf(const std::string& text);
/// Of materials that do not look as their file says.
void warnOf(const ColladaEffects& effects, const std::string& file, SceneBuilder& builder);

/// `text` in which the values of parameters stand in the place of each <param> that refers to them: Assimp
/// 5.2 does not follow it. Lines stay where they are.
std::string withParameters(const std::string& text);

}  // namespace sunlit::scene
