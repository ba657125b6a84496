#include "sunlit/light/geometry.h"

#include <utility>

namespace sunlit::light {

Geometry::Geometry(std::shared_ptr<const scene::Scene> scene_to_flatten)
    : Geometry(scene_to_flatten, std::make_shared<const scene::Shape>(*scene_to_flatten)) {}

Geometry::Geometry(std::shared_ptr<const scene::Scene> of_scene, std::shared_ptr<const scene::Shape> of_shape)
    : scene(std::move(of_scene)),
      shape(std::move(of_shape)),
      positions(shape->positions),
      normals(shape->normals),
      texture_coordinates(shape->texture_coordinates),
      more_texture_coordinates(shape->more_texture_coordinates.begin(),
                               shape->more_texture_coordinates.end()),
      tangents(shape->tangents),
      colors(shape->colors),
      triangles(shape->triangles),
      planes(shape->planes),
      materials(shape->materials),
      chunks(shape->chunks) {}

}  // namespace sunlit::light
