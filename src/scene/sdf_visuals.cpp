#include "scene/sdf_visuals.h"

#include <algorithm>
#include <optional>
#include <sdf/Box.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "scene/gazebo_material.h"
#include "scene/primitives.h"
#include "scene/sdf_library.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_shapes.h"
#include "scene/sdf_terrain.h"

namespace sunlit::scene {
namespace {

std::optional<Mesh> primitive(const sdf::Geometry& geometry) {
  if (const std::optional<Eigen::Vector3d> radii = ellipsoidRadii(geometry)) return makeEllipsoid(*radii);
  if (const std::optional<RoundSize> size = capsuleOf(geometry))
    return makeCapsule(size->radius, size->length);
  if (const std::optional<RoundSize> size = coneOf(geometry)) return makeCone(size->radius, size->length);
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return makeBox(toEigen(geometry.BoxShape()->Size()));
    case sdf::GeometryType::SPHERE:
      return makeEllipsoid(Eigen::Vector3d::Constant(geometry.SphereShape()->Radius()));
    case sdf::GeometryType::CYLINDER:
      return makeCylinder(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length());
    case sdf::GeometryType::PLANE: {
      const ignition::math::Vector2d size = geometry.PlaneShape()->Size();
      return makePlane({size.X(), size.Y()}, toEigen(geometry.PlaneShape()->Normal()));
    }
    default:
      return std::nullopt;
  }
}

/// Level planes, below which no light comes to anything: Gazebo's own ground says that it casts no shadow.
bool isGround(const sdf::Visual& visual, const Eigen::Affine3d& map_from_visual) {
  if (visual.Geom() == nullptr || visual.Geom()->Type() != sdf::GeometryType::PLANE) return false;
  const Eigen::Vector3d normal = toEigen(visual.Geom()->PlaneShape()->Normal());
  return (map_from_visual.linear() * normal).normalized().z() > 0.99;
}

}  // namespace

void SdfVisuals::addFile(const SdfFile& file) {
  for (std::uint64_t w = 0; w < file.root.WorldCount(); ++w) {
    const sdf::World& world = *file.root.WorldByIndex(w);
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i)
      addModel(*world.ModelByIndex(i), Eigen::Affine3d::Identity(), "");
    addRoads(world);
  }
  const sdf::Model* model = modelOf(file.root);
  if (model != nullptr) addModel(*model, Eigen::Affine3d::Identity(), "");
  addIncluded(file, model != nullptr ? model->Name() : "");
}

/// `own_name` stands in for the name that the model of `file` has in the file.
void SdfVisuals::addIncluded(const SdfFile& file, const std::string& own_name) {
  for (const SdfFile::Included& one : file.included) {
    std::string within = one.within;
    if (modelOf(file.root) != nullptr) within.replace(0, modelOf(file.root)->Name().size(), own_name);
    const auto place = map_from_models_.find(within);
    if (!within.empty() && place == map_from_models_.end()) continue;  // deleted with what it is in
    const Eigen::Affine3d map_from_within = within.empty() ? Eigen::Affine3d::Identity() : place->second;
    const std::string name = within.empty() ? one.name : within + "::" + one.name;
    addModelAt(*modelOf(one.file->root), map_from_within * one.within_from_model, name);
    addIncluded(*one.file, name);
  }
}

void SdfVisuals::addModel(const sdf::Model& model, const Eigen::Affine3d& map_from_parent,
                          const std::string& scope) {
  const std::string name = scope + model.Name();
  addModelAt(model, map_from_parent * parentFrom(model, name), name);
}

/// `map_from_file`: of the model's own frame, unless a state says otherwise, to which models that are merged
/// into others are not known.
void SdfVisuals::addModelAt(const sdf::Model& model, const Eigen::Affine3d& map_from_file,
                            const std::string& full_name) {
  const std::string name = withoutMerged(full_name);
  if (state_.isDeleted(name)) return;
  const bool merged = isMerged(full_name);
  const std::optional<Eigen::Isometry3d> stated = merged ? std::nullopt : state_.mapFrom(name);
  const Eigen::Affine3d map_from_unscaled = stated ? Eigen::Affine3d(*stated) : map_from_file;
  const Eigen::Affine3d map_from_model =
      merged ? map_from_file : map_from_unscaled * Eigen::Scaling(state_.scaleOf(name));
  map_from_models_[full_name] = map_from_model;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    const std::string link_name = name + "::" + link.Name();
    // A state tells where links are without the scale, which moves them apart in the picture alone.
    const std::optional<Eigen::Isometry3d> link_stated = state_.mapFrom(link_name);
    addLink(link,
            link_stated ? map_from_model * (map_from_unscaled.inverse() * *link_stated)
                        : map_from_model * parentFrom(link, link_name),
            link_name);
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    addModel(*model.ModelByIndex(i), map_from_model, full_name + "::");
  }
}

void SdfVisuals::addLink(const sdf::Link& link, const Eigen::Affine3d& map_from_link,
                         const std::string& name) {
  // By the model: "lamp_post::link".
  const std::string group = name.substr(0, name.rfind("::"));
  for (std::uint64_t i = 0; i < link.LightCount(); ++i) {
    const sdf::Light& light = *link.LightByIndex(i);
    addLight(light, map_from_link, {name + "::" + light.Name(), group});
  }
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    addVisual(*link.VisualByIndex(i), map_from_link, name + "::");
  }
}

void SdfVisuals::addLight(const sdf::Light& light, const Eigen::Affine3d& map_from_parent,
                          const LightName& name) {
  Eigen::Affine3d map_from_light = map_from_parent * Eigen::Affine3d(parentFrom(light, name.name));
  if (const std::optional<Eigen::Isometry3d> stood = state_.mapFrom(name.name)) map_from_light = *stood;
  if (std::optional<Lamp> lamp = lampOf(light, map_from_light, name, builder_))
    builder_.addLamp(*std::move(lamp));
}

void SdfVisuals::addVisual(const sdf::Visual& visual, const Eigen::Affine3d& map_from_link,
                           const std::string& scope) {
  const std::string name = scope + visual.Name();
  const float opacity = std::min(1.0f - visual.Transparency(), 1.0f);
  if (!(opacity > 0.0f)) {
    builder_.warn("visuals were left out, they are wholly transparent", name);
    return;
  }
  const Eigen::Affine3d map_from_visual = map_from_link * parentFrom(visual, name);
  if (!visual.CastShadows() && !isGround(visual, map_from_visual))
    builder_.warn("visuals cast shadows although their files say that they should not", name);
  if (visual.Geom() != nullptr && visual.Geom()->Type() == sdf::GeometryType::MESH) {
    addMeshShape(visual, map_from_visual, name, opacity);
  } else if (std::optional<Mesh> shape = shapeOf(visual, name)) {
    shape->name = name;
    // Gazebo overlooks where the model of a height map stands, and worlds are made to look right in it.
    const bool ground = heightmapOf(*visual.Geom()).has_value();
    const bool sheet = ground || visual.Geom()->Type() == sdf::GeometryType::PLANE;
    shape->material = builder_.veiled(shape->material, opacity,
                                      sheet ? SceneBuilder::Faces::kOne : SceneBuilder::Faces::kTwo);
    if (ground && !map_from_visual.isApprox(Eigen::Affine3d::Identity()))
      builder_.warn("height maps stand where their <pos> says, not where their models do, as in Gazebo",
                    name);
    builder_.addMesh(*shape, ground ? Eigen::Affine3d::Identity() : map_from_visual);
  }
}

/// None, after a warning, where there is nothing to draw.
std::optional<Mesh> SdfVisuals::shapeOf(const sdf::Visual& visual, const std::string& name) {
  const sdf::Geometry* geometry = visual.Geom();
  const sdf::ElementPtr element = geometry == nullptr ? nullptr : geometry->Element();
  const std::optional<int> own_material = materials_.add(visual.Material(), name);
  const int material = own_material ? *own_material : materials_.neutral();
  if (geometry != nullptr) {
    if (const std::optional<SdfHeightmap> ground = heightmapOf(*geometry))
      return terrainOf(*ground, {material, name}, builder_, finder_);
  }
  std::optional<Mesh> shape = geometry == nullptr ? std::nullopt : primitive(*geometry);
  if (!shape && element) shape = polylineOf(*element, file_ + ": visual " + name);
  if (shape && !shape->triangles.empty()) {
    materials_.put(material, *shape);
    return shape;
  }
  const char* const what = element && element->HasElement("image") ? " (an <image>)"
                           : shape                                 ? " (outlines that enclose nothing)"
                                                                   : "";
  builder_.warn("visuals have no shape that can be drawn", name + what);
  return std::nullopt;
}

void SdfVisuals::addRoads(const sdf::World& world) {
  const sdf::ElementPtr element = world.Element();
  for (sdf::ElementPtr road = element ? firstIn(*element, "road") : nullptr; road;
       road = road->GetNextElement("road")) {
    const auto name = road->Get<std::string>("name");
    Mesh mesh = roadOf(*road, file_ + ": road " + name);
    mesh.name = name;
    sdf::Material source;
    std::optional<int> material;
    if (road->HasElement("material")) {
      const sdf::Errors errors = source.Load(road->GetElement("material"));
      if (errors.empty()) material = materials_.add(&source, name);
      if (!errors.empty())
        builder_.warn("materials of roads cannot be read, they look like asphalt",
                      errors[0].Message() + " of " + name);
    }
    materials_.put(material ? *material : bareRoad(), mesh);
    if (mesh.triangles.empty()) builder_.warn("roads have less than two points, they were left out", name);
    builder_.addMesh(mesh, Eigen::Affine3d::Identity());
  }
}

/// As a road looks in Gazebo that is given no material.
int SdfVisuals::bareRoad() {
  if (!bare_road_) {
    Material asphalt;
    asphalt.name = "Gazebo/Road";
    asphalt.base_color = gazeboLook(asphalt.name).value().color;
    bare_road_ = builder_.addMaterial(asphalt, AlphaRule::kDeclared);
  }
  return *bare_road_;
}

void SdfVisuals::addMeshShape(const sdf::Visual& visual, const Eigen::Affine3d& map_from_visual,
                              const std::string& name, float opacity) {
  const sdf::Mesh& mesh = *visual.Geom()->MeshShape();
  const std::string& from = mesh.FilePath().empty() ? file_ : mesh.FilePath();
  ModelMeshes& meshes = SdfMaterials::isLook(visual.Material()) ? bare_meshes_ : meshes_;
  const std::vector<MeshPart>* all = meshes.partsOf(mesh.Uri(), from, from + ": visual " + name);
  if (all == nullptr) return;
  const std::optional<int> material = materials_.add(visual.Material(), name);
  std::vector<MeshPart> parts;
  for (const MeshPart& part : *all) {
    const bool wanted =
        mesh.Submesh().empty() || mesh.Submesh() == part.node || mesh.Submesh() == part.geometry;
    if (wanted) parts.push_back(part);
  }
  if (parts.empty()) {
    builder_.warn("meshes have nothing to draw",
                  mesh.Uri() + (mesh.Submesh().empty() ? "" : " by the name of " + mesh.Submesh()) +
                      " of visual " + name);
  }
  Eigen::Affine3d map_from_file = map_from_visual * Eigen::Scaling(toEigen(mesh.Scale()));
  if (!mesh.Submesh().empty() && mesh.CenterSubmesh()) {
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : parts) {
      for (const Eigen::Vector3f& position : part.mesh.positions)
        box.extend(part.file_from_node * position.cast<double>());
    }
    if (!box.isEmpty()) map_from_file.translate(-box.center());
  }
  for (MeshPart& part : parts) {
    part.mesh.name = name + "/" + part.mesh.name;
    leaveCoordinates(!material, part);
    if (material) materials_.put(*material, part.mesh);
    part.mesh.material = builder_.veiled(part.mesh.material, opacity, SceneBuilder::Faces::kOne);
    builder_.addPiece(part.mesh, map_from_file * part.file_from_node);
  }
}

}  // namespace sunlit::scene
