#include "scene/robot/urdf_visuals.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "scene/color.h"
#include "scene/gazebo_material.h"
#include "scene/primitives.h"
#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

void checkPositive(double value, const std::string& what, const std::string& place) {
  if (std::isfinite(value) && value > 0.0) return;
  throw std::runtime_error(refusal(place + ": its " + what, textOf(value), "above 0 m"));
}

Mesh primitive(const urdf::Geometry& geometry, const std::string& place) {
  if (geometry.type == urdf::Geometry::BOX) {
    const urdf::Vector3& size = static_cast<const urdf::Box&>(geometry).dim;
    for (const double side : {size.x, size.y, size.z}) checkPositive(side, "box's side", place);
    return makeBox({size.x, size.y, size.z});
  }
  if (geometry.type == urdf::Geometry::SPHERE) {
    const double radius = static_cast<const urdf::Sphere&>(geometry).radius;
    checkPositive(radius, "sphere's radius", place);
    return makeEllipsoid(Eigen::Vector3d::Constant(radius));
  }
  const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
  checkPositive(cylinder.radius, "cylinder's radius", place);
  checkPositive(cylinder.length, "cylinder's length", place);
  return makeCylinder(cylinder.radius, cylinder.length);
}

/// A texture brings its own.
float opacityOf(const urdf::Visual& visual) {
  const bool colored = visual.material && visual.material->texture_filename.empty();
  return colored ? std::min(visual.material->color.a, 1.0f) : 1.0f;
}

/// The <material> of SDF that names this one of a script.
std::string scriptElement(const std::string& name) {
  tinyxml2::XMLPrinter printer;  // which escapes what the name may have
  for (const char* const element : {"material", "script", "name"}) printer.OpenElement(element);
  printer.PushText(name.c_str());
  for (int i = 0; i < 3; ++i) printer.CloseElement();
  return printer.CStr();
}

}  // namespace

void UrdfVisuals::add(const urdf::Link& link, const std::string& place, const GazeboMaterial& of_gazebo) {
  of_gazebo_ = of_gazebo;
  for (std::size_t i = 0; i < link.visual_array.size(); ++i) {
    const urdf::Visual& visual = *link.visual_array[i];
    const std::string name = visual.name.empty() ? std::to_string(i + 1) : visual.name;
    addVisual(visual, link.name + "::" + name, place + ", visual " + name);
  }
}

void UrdfVisuals::addVisual(const urdf::Visual& visual, const std::string& name, const std::string& place) {
  const float opacity = opacityOf(visual);
  if (!(opacity > 0.0f)) {
    builder_.warn("visuals were left out, they are wholly transparent", place);
    return;
  }
  if (!visual.geometry) throw std::runtime_error(place + ": it has no geometry");
  if (visual.geometry->type == urdf::Geometry::MESH) {
    const auto& mesh = static_cast<const urdf::Mesh&>(*visual.geometry);
    // Of one that is missing no material is looked for.
    if (meshes_.partsOf(mesh.filename, origin_, place) == nullptr) return;
  }
  const std::optional<int> own_material = material(visual, place);
  const Eigen::Isometry3d link_from_visual = toEigen(visual.origin);
  if (visual.geometry->type == urdf::Geometry::MESH) {
    addMeshShape(static_cast<const urdf::Mesh&>(*visual.geometry),
                 {own_material, visual.material == nullptr, opacity, link_from_visual}, name, place);
    return;
  }
  Mesh mesh = primitive(*visual.geometry, place);
  mesh.name = name;
  looks_.put(*own_material, mesh);
  mesh.material = builder_.veiled(mesh.material, opacity, SceneBuilder::Faces::kTwo);
  builder_.addMesh(mesh, Eigen::Affine3d(link_from_visual));
}

/// None where the visual has none and is a mesh, which may bring its own.
std::optional<int> UrdfVisuals::material(const urdf::Visual& visual, const std::string& place) {
  const urdf::Material* source = visual.material.get();
  if (source == nullptr && !visual.material_name.empty()) {
    builder_.warn("materials do not exist, a neutral one takes their place",
                  visual.material_name + " of " + place);
  }
  if (!of_gazebo_.name.empty() || !of_gazebo_.element.empty()) {
    if (source != nullptr)
      builder_.warn(kNotRendered, gazeboMaterialOf(place) + ", which has its own: without it");
    else if (const std::optional<int> found = materialOfGazebo(place))
      return found;
  }
  if (source == nullptr && visual.geometry && visual.geometry->type == urdf::Geometry::MESH)
    return std::nullopt;
  std::ostringstream content;
  if (source != nullptr) {
    const urdf::Color& c = source->color;
    content << source->name << '\n' << source->texture_filename << '\n' << c.r << ' ' << c.g << ' ' << c.b;
  }
  const auto known = material_by_content_.find(content.str());
  if (known != material_by_content_.end()) return known->second;

  Material looks;
  looks.name = source != nullptr ? source->name : "neutral";
  looks.base_color = kNeutral;
  if (source != nullptr && source->texture_filename.empty()) {
    looks.base_color = linearFromSrgb({source->color.r, source->color.g, source->color.b});
  } else if (source != nullptr) {
    Found found = finder_.find(source->texture_filename, origin_);
    if (!found.file) found = finder_.findTexture(source->texture_filename, origin_);
    if (found.file) {
      looks.base_texture = builder_.textureFromFile(*found.file);
      looks.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
    } else {
      builder_.warn(kMissingTextures, source->texture_filename + " of " + place);
    }
  }
  return material_by_content_[content.str()] = builder_.addMaterial(looks, AlphaRule::kFromTexture);
}

/// For messages.
std::string UrdfVisuals::gazeboMaterialOf(const std::string& place) const {
  const std::string name = of_gazebo_.element.empty() ? of_gazebo_.name : "within <visual>";
  return "<gazebo> material " + name + " of " + place;
}

std::optional<int> UrdfVisuals::materialOfGazebo(const std::string& place) {
  if (!of_gazebo_.element.empty()) return looks_.add(of_gazebo_.element, place);
  const std::string& name = of_gazebo_.name;
  const auto [known, is_new] = gazebo_material_by_name_.try_emplace(name);
  if (is_new) known->second = gazeboMaterialCalled(name, place);
  if (!known->second)
    builder_.warn("materials do not exist, a neutral one takes their place", name + " of " + place);
  return known->second;
}

/// Looks through folders, so that it is asked once for each name.
std::optional<int> UrdfVisuals::gazeboMaterialCalled(const std::string& name, const std::string& place) {
  if (const std::optional<GazeboLook> look = gazeboLook(name)) {
    if (look->pictured) builder_.warn(kPicturesOfGazebo, name);
    return builder_.addMaterial(materialOf(*look, name), AlphaRule::kFromTexture);
  }
  if (!scripts_.find({name, {}, origin_})) return std::nullopt;
  return looks_.add(scriptElement(name), place);
}

void UrdfVisuals::addMeshShape(const urdf::Mesh& shape, const MeshUse& use, const std::string& name,
                               const std::string& place) {
  const Eigen::Affine3d link_from_file =
      Eigen::Affine3d(use.link_from_visual) * Eigen::Scaling(shape.scale.x, shape.scale.y, shape.scale.z);
  const std::vector<MeshPart>* parts = meshes_.partsOf(shape.filename, origin_, place);
  if (parts == nullptr) return;
  if (parts->empty()) builder_.warn("meshes have nothing to draw", shape.filename + " of " + place);
  for (MeshPart part : *parts) {
    part.mesh.name = name + "/" + part.mesh.name;
    leaveCoordinates(true, part);
    // As RViz does: the material of the URDF is for meshes that bring none.
    if (use.own_material && part.bare) {
      looks_.put(*use.own_material, part.mesh);
      part.mesh.material = builder_.veiled(part.mesh.material, use.opacity, SceneBuilder::Faces::kOne);
    } else if (use.own_material && use.is_of_gazebo) {
      builder_.warn(kNotRendered, gazeboMaterialOf(place) + ", whose mesh has its own: without it");
    }
    builder_.addPiece(part.mesh, link_from_file * part.file_from_node);
  }
}

}  // namespace sunlit::scene
