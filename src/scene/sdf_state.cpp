#include "scene/sdf_state.h"

#include <array>
#include <cmath>
#include <ignition/math/Pose3.hh>
#include <sstream>
#include <stdexcept>

#include "scene/sdf_pose.h"
#include "scene/sdf_xml.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;

/// The numbers in the child `key` of `element`; `usual` where there is none.
template <std::size_t n>
std::array<double, n> numbersOf(const XMLElement& element, const char* key, std::array<double, n> usual,
                                const std::string& name) {
  const std::string text = childText(element, key);
  if (text.empty()) return usual;
  std::istringstream words(text);
  std::array<double, n> numbers{};
  for (double& number : numbers) {
    if (!(words >> number) || !std::isfinite(number)) {
      throw std::runtime_error(name + ": its " + key + " in <state> is not " + std::to_string(n) +
                               " finite numbers");
    }
  }
  return numbers;
}

Eigen::Isometry3d poseOf(const XMLElement& element, const std::string& name) {
  const std::array<double, 6> p = numbersOf<6>(element, "pose", {}, name);
  return toEigen(ignition::math::Pose3d(p[0], p[1], p[2], p[3], p[4], p[5]));
}

template <typename Each>
void forEach(const XMLElement& parent, const char* kind, const Each& each) {
  for (const auto* one = parent.FirstChildElement(kind); one != nullptr; one = one->NextSiblingElement(kind))
    each(*one);
}

/// A state has them among its models.
void leaveOutActors(XMLElement& world, XMLElement& state) {
  std::set<std::string> actors;
  for (const XMLElement* actor : childrenOf(world, "actor")) actors.insert(attributeOf(*actor, "name"));
  for (XMLElement* model : childrenOf(state, "model")) {
    if (actors.count(attributeOf(*model, "name")) > 0) state.DeleteChild(model);
  }
}

}  // namespace

std::unique_ptr<tinyxml2::XMLDocument> takeState(XMLElement& sdf) {
  std::unique_ptr<tinyxml2::XMLDocument> taken;
  for (XMLElement* world : childrenOf(sdf, "world")) {
    for (XMLElement* state : childrenOf(*world, "state")) {
      if (!taken) {
        for (XMLElement* insertions : childrenOf(*state, "insertions")) {
          for (XMLElement* added : childrenOf(*insertions)) world->InsertEndChild(added);
        }
        taken = std::make_unique<tinyxml2::XMLDocument>();
        taken->InsertEndChild(state->DeepClone(taken.get()));
        leaveOutActors(*world, *taken->FirstChildElement());
      }
      world->DeleteChild(state);
    }
  }
  return taken;
}

SdfState::SdfState(const tinyxml2::XMLDocument& document, const std::string& file) : file_(file) {
  const XMLElement& state = *document.FirstChildElement("state");
  forEach(state, "model", [&](const XMLElement& model) { readModel(model, ""); });
  forEach(state, "light", [&](const XMLElement& light) {
    const std::string name = attributeOf(light, "name");
    entries_[name] = {poseOf(light, file_ + ": " + name), false};
  });
  forEach(state, "deletions", [&](const XMLElement& deletions) {
    forEach(deletions, "name", [&](const XMLElement& name) {
      if (name.GetText() != nullptr) deleted_.insert(name.GetText());
    });
  });
}

void SdfState::readModel(const XMLElement& model, const std::string& scope) {
  const std::string name = scope + attributeOf(model, "name");
  entries_[name] = {poseOf(model, file_ + ": " + name), true};
  const std::array<double, 3> scale = numbersOf<3>(model, "scale", {1.0, 1.0, 1.0}, file_ + ": " + name);
  scales_[name] = {scale[0], scale[1], scale[2]};
  forEach(model, "link", [&](const XMLElement& link) {
    const std::string full_name = name + "::" + attributeOf(link, "name");
    entries_[full_name] = {poseOf(link, file_ + ": " + full_name), false};
  });
  forEach(model, "model", [&](const XMLElement& nested) { readModel(nested, name + "::"); });
}

std::optional<Eigen::Isometry3d> SdfState::mapFrom(const std::string& full_name) const {
  asked_.insert(full_name);
  const auto found = entries_.find(full_name);
  if (found == entries_.end()) return std::nullopt;
  return found->second.map_from_frame;
}

Eigen::Vector3d SdfState::scaleOf(const std::string& model) const {
  const auto found = scales_.find(model);
  return found == scales_.end() ? Eigen::Vector3d::Ones() : found->second;
}

std::vector<std::string> SdfState::unknownModels() const {
  std::vector<std::string> unknown;
  for (const auto& [name, entry] : entries_) {
    if (entry.is_model && asked_.count(name) == 0) unknown.push_back(name);
  }
  return unknown;
}

}  // namespace sunlit::scene
