/// SDF files as libsdformat reads them, each once, however often it is included.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <set>
#include <string>
#include <vector>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Names of models that are merged into those that include them begin with it, as libsdformat calls their
/// frames.
constexpr const char* kMergedPrefix = "_merged__";

/// `full_name` without the models that are merged into others: their links are those of the others.
std::string withoutMerged(const std::string& full_name);
/// Whether the model of this full name, or of this name, is merged into the one that includes it.
bool isMerged(const std::string& full_name);

/// A file without what it includes.
struct SdfFile {
  /// A model that the file includes.
  struct Included {
    std::string within;   ///< full name of the model that includes it; empty: the world
    std::string name;     ///< its own, there
    const SdfFile* file;  ///< whose modelOf() it is
    Eigen::Isometry3d within_from_model;
  };

  std::string path;
  sdf::Root root;
  std::string placement_frame;  ///< of modelOf(root)
  std::vector<Included> included;
  std::size_t models = 0;  ///< in it and in all that it includes, each as often as it is included
  std::unique_ptr<tinyxml2::XMLDocument> state;  ///< a <state> element; null where the world has none
};

/// libsdformat reads a file anew for every <include>, 35 ms each, and gives up at the first that is missing.
/// So each file is read by itself, and where it includes a model, libsdformat is told of the frames in that
/// alone, by loadRoot().
class SdfFiles {
 public:
  SdfFiles(const ResourceFinder& finder, SceneBuilder& builder) : finder_(finder), builder_(builder) {}

  /// Reads `file` and all that it includes; odd things in them become warnings of the builder. Throws
  /// std::runtime_error naming file and line of what cannot be read, and for missing models where they were
  /// looked for; but an included model that is missing or cannot be read is a warning where the finder says
  /// so. The result lives as long as this.
  const SdfFile& read(const std::string& file);

 private:
  const SdfFile& open(const std::string& path);
  void resolveIncludes(tinyxml2::XMLElement& sdf, SdfFile& file);
  void resolveInclude(tinyxml2::XMLElement& include, SdfFile& file);
  const SdfFile* included(const tinyxml2::XMLElement& include, const SdfFile& file);
  void parse(tinyxml2::XMLDocument& document, SdfFile& file);

  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  std::map<std::string, std::unique_ptr<SdfFile>> files_;
  std::set<std::string> open_;                  ///< being read
  std::vector<const SdfFile*> by_token_;        ///< what stands in the place of an address
  std::map<std::string, std::string> missing_;  ///< addresses looked for in vain, by where the first stands
};

}  // namespace sunlit::scene
