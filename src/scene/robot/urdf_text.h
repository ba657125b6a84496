/// A URDF as urdfdom reads it, with places for messages.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

class TiXmlElement;

namespace sunlit::scene {

class UrdfText {
 public:
  /// `origin` names the text in messages. Throws std::runtime_error with line and reason if it is no URDF.
  UrdfText(const std::string& text, const std::string& origin);

  const urdf::ModelInterface& model() const { return *model_; }
  /// What urdfdom found odd, but passed, of what can be seen.
  const std::vector<std::string>& oddities() const { return oddities_; }
  /// Elements of links that URDF has none of, and that have a shape, as a misspelt <visual> has one, with
  /// their places.
  const std::vector<std::string>& unknown() const { return unknown_; }
  /// Names of the links in the order of the text.
  const std::vector<std::string>& links() const { return links_; }
  /// "<origin>:<line>: <kind> <name>"; `kind` is link or joint.
  std::string place(const std::string& kind, const std::string& name) const;

 private:
  /// Notes links and joints; returns what is seen of the text.
  std::string read(const std::string& text);
  void requireNoMacros(const TiXmlElement& robot) const;
  void noteUnknown(const TiXmlElement& link);
  std::string lineOf(const TiXmlElement& element) const;
  [[noreturn]] void fail(const std::vector<std::string>& complaints) const;

  std::string origin_;
  urdf::ModelInterfaceSharedPtr model_;
  std::vector<std::string> oddities_, unknown_;
  std::vector<std::string> links_;
  std::map<std::pair<std::string, std::string>, int> lines_;  ///< by kind and name
};

}  // namespace sunlit::scene
