#include "scene/sdf_state.h"

#include <algorithm>
#include <sdf/Element.hh>
#include <stdexcept>

#include "scene/sdf_pose.h"

namespace sunlit::scene {
namespace {

constexpr const char* kModel = "model";
constexpr const char* kInsertions = "insertions";

Eigen::Isometry3d poseOf(sdf::Element& element, const std::string& name) {
  const auto pose = element.Get<ignition::math::Pose3d>("pose");
  if (!pose.IsFinite()) throw std::runtime_error(name + ": its pose in <state> is not finite");
  return toEigen(pose);
}

template <typename Each>
void forEach(sdf::Element& parent, const std::string& kind, const Each& each) {
  if (!parent.HasElement(kind)) return;
  for (sdf::ElementPtr one = parent.GetElement(kind); one != nullptr; one = one->GetNextElement(kind))
    each(*one);
}

}  // namespace

SdfState::SdfState(const sdf::World& world, SceneBuilder& builder) {
  const sdf::ElementPtr element = world.Element();
  if (element == nullptr || !element->HasElement("state")) return;
  sdf::Element& state = *element->GetElement("state");
  forEach(state, kModel, [&](sdf::Element& model) { readModel(model, "", builder); });
  if (state.HasElement("deletions")) {
    forEach(*state.GetElement("deletions"), "name",
            [&](sdf::Element& name) { deleted_.insert(name.Get<std::string>()); });
  }
  if (state.HasElement(kInsertions)) {
    forEach(*state.GetElement(kInsertions), kModel, [&](sdf::Element&) {
      builder.count("models that <state> inserts into the world were not read");
    });
  }
}

void SdfState::readModel(sdf::Element& model, const std::string& scope, SceneBuilder& builder) {
  const std::string name = scope + model.Get<std::string>("name");
  entries_[name] = {poseOf(model, name), true};
  const auto scale = model.Get<ignition::math::Vector3d>("scale", ignition::math::Vector3d::One).first;
  if (scale != ignition::math::Vector3d::One)
    builder.warn("model " + name + " is drawn in its own size: the scale in <state> was not read");
  forEach(model, "link", [&](sdf::Element& link) {
    const std::string full_name = name + "::" + link.Get<std::string>("name");
    entries_[full_name] = {poseOf(link, full_name), false};
  });
  forEach(model, kModel, [&](sdf::Element& nested) { readModel(nested, name + "::", builder); });
}

std::optional<Eigen::Isometry3d> SdfState::mapFrom(const std::string& full_name) const {
  asked_.insert(full_name);
  const auto found = entries_.find(full_name);
  if (found == entries_.end()) return std::nullopt;
  return found->second.map_from_frame;
}

std::size_t SdfState::unknownModels() const {
  return static_cast<std::size_t>(std::count_if(entries_.begin(), entries_.end(), [&](const auto& entry) {
    return entry.second.is_model && asked_.count(entry.first) == 0;
  }));
}

}  // namespace sunlit::scene
