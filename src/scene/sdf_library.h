/// libsdformat 12 and 9 by one face.
#pragma once

#include <sdf/sdf_config.h>
#include <Eigen/Core>
#include <optional>
#include <sdf/Element.hh>
#include <sdf/Error.hh>
#include <sdf/Geometry.hh>
#include <sdf/Light.hh>
#include <sdf/Model.hh>
#include <sdf/Pbr.hh>
#include <sdf/Root.hh>
#include <string>

#include "scene/sdf_pose.h"

#if SDF_MAJOR_VERSION >= 12
#include <sdf/Capsule.hh>
#include <sdf/Ellipsoid.hh>
#endif

namespace sunlit::scene {

/// The first child of this name; null where there is none.
inline sdf::ElementPtr firstIn(sdf::Element& parent, const std::string& name) {
  return parent.HasElement(name) ? parent.GetElementImpl(name) : nullptr;
}

/// Half the width of a round solid, and how long it is; of a capsule, how far apart the centres of its ends
/// are.
struct RoundSize {
  double radius, length;
};
/// Of an element that is not in the schema; none where there is no such.
inline std::optional<RoundSize> roundIn(const sdf::Geometry& geometry, const std::string& name) {
  const sdf::ElementPtr shape = geometry.Element() ? firstIn(*geometry.Element(), name) : nullptr;
  if (!shape) return std::nullopt;
  return RoundSize{shape->Get<double>("radius", 0.5).first, shape->Get<double>("length", 1.0).first};
}

#if SDF_MAJOR_VERSION >= 12

/// The model, or light, of a file that has no world; null where there is none.
inline const sdf::Model* modelOf(const sdf::Root& root) {
  return root.Model();
}
inline const sdf::Light* lightOf(const sdf::Root& root) {
  return root.Light();
}

inline double strengthOf(const sdf::Light& light) {
  return light.Intensity();
}
inline std::string lightMapOf(const sdf::PbrWorkflow& workflow) {
  return workflow.LightMap();
}
inline std::optional<int> lineOf(const sdf::Error& error) {
  return error.LineNumber();
}

/// None where it has another shape.
inline std::optional<Eigen::Vector3d> ellipsoidRadii(const sdf::Geometry& geometry) {
  if (geometry.Type() != sdf::GeometryType::ELLIPSOID) return std::nullopt;
  return toEigen(geometry.EllipsoidShape()->Radii());
}
inline std::optional<RoundSize> capsuleOf(const sdf::Geometry& geometry) {
  if (geometry.Type() != sdf::GeometryType::CAPSULE) return std::nullopt;
  return RoundSize{geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length()};
}

#else

inline const sdf::Model* modelOf(const sdf::Root& root) {
  return root.ModelByIndex(0);
}
inline const sdf::Light* lightOf(const sdf::Root& root) {
  return root.LightByIndex(0);
}

inline double strengthOf(const sdf::Light& light) {
  return light.Element() ? light.Element()->Get<double>("intensity", 1.0).first : 1.0;
}
inline std::string lightMapOf(const sdf::PbrWorkflow& workflow) {
  return workflow.Element() ? workflow.Element()->Get<std::string>("light_map", "").first : "";
}
/// 9 names none.
inline std::optional<int> lineOf(const sdf::Error&) {
  return std::nullopt;
}

/// Of an element that is not in the schema of 9.
inline std::optional<Eigen::Vector3d> ellipsoidRadii(const sdf::Geometry& geometry) {
  const sdf::ElementPtr shape = geometry.Element() ? firstIn(*geometry.Element(), "ellipsoid") : nullptr;
  if (!shape) return std::nullopt;
  return toEigen(shape->Get<ignition::math::Vector3d>("radii", ignition::math::Vector3d::One).first);
}
inline std::optional<RoundSize> capsuleOf(const sdf::Geometry& geometry) {
  return roundIn(geometry, "capsule");
}

#endif

/// Of SDF 1.11.
inline std::optional<RoundSize> coneOf(const sdf::Geometry& geometry) {
  const std::optional<RoundSize> size = roundIn(geometry, "cone");
  return size && size->radius > 0.0 && size->length > 0.0 ? size : std::nullopt;
}

}  // namespace sunlit::scene
