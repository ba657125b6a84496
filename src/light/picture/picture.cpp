#include "sunlit/light/picture.h"

#include <cassert>
#include <utility>

#include "light/picture/bodies/body_light.h"
#include "light/picture/gather/final_gather.h"
#include "light/picture/lamps/bounced_light.h"
#include "light/picture/lighting.h"
#include "light/picture/lights_outside.h"
#include "light/picture/ready_picture.h"
#include "sunlit/light/lamps.h"
#include "sunlit/quantity/range.h"

namespace sunlit::light {

struct PreparedPicture::Implementation {
  image::LinearImage illuminate(const Illumination& light) const {
    assert(scene);  // else nothing was prepared
    if (!views) return light::illuminate(ready, *scene, *visibility, light);
    Illumination here = light;
    if (light.body_lamps) {
      here.bounced = std::make_shared<const std::vector<BouncedLight>>(
          bouncedLight(*light.body_lamps, map_from_body, *visibility));
    }
    // Before the lamps of bodies are among those of the world: of their light, bodies see what is bounced.
    here.bodies = std::make_shared<const std::vector<AroundLight>>(body_light->around(*views, here));
    if (light.body_lamps) here.lamps = lampsHere(light);
    return light::illuminate(ready, *scene, *visibility, here);
  }

  std::vector<image::LightOutside> lightsOutside(const Illumination& light, float nearest_m) const {
    Illumination here = light;
    if (views && light.body_lamps) here.lamps = lampsHere(light);
    return light::lightsOutside(surfaces(), *visibility, here, nearest_m);
  }

  const Surfaces& surfaces() const { return ready.seen.surfaces; }
  Surfaces takeSurfaces() {
    Surfaces surfaces = std::move(ready.seen.surfaces);
    ready.seen.surfaces = Surfaces();
    ready.seen.table = LightTable();  // not kept beside the next one
    ready.mirrors.clear();
    return surfaces;
  }

  /// Those of the world, and those of its bodies where they stand.
  std::shared_ptr<const std::vector<scene::Lamp>> lampsHere(const Illumination& light) const {
    std::vector<scene::Lamp> lamps;
    if (light.lamps) lamps = *light.lamps;
    for (const BodyLamp& lamp : *light.body_lamps)
      lamps.push_back(placed(lamp.lamp, map_from_body[lamp.body]));
    return std::make_shared<const std::vector<scene::Lamp>>(std::move(lamps));
  }

  std::shared_ptr<const scene::Scene> scene;
  std::shared_ptr<const Visibility> visibility;
  std::vector<Eigen::Isometry3d> map_from_body;
  std::shared_ptr<const BodyLight> body_light;
  std::shared_ptr<const BodyLight::Views> views;  ///< of the bodies; null: none stand here
  ReadyPicture ready;
};

class PicturePreparer::Implementation {
 public:
  Implementation(const World& world, int final_gather, const Implementation* beside) : world_(world) {
    require("final_gather", final_gather, {0, kMostRays});
    if (world.transport && final_gather > 0) {
      if (beside && beside->gather_ && beside->gather_->finds(*world.geometry, final_gather))
        gather_ = beside->gather_;
      else
        gather_ = std::make_shared<FinalGather>(world.geometry, world.visibility, final_gather);
    }
    if (world.bodies) body_light_ = std::make_shared<const BodyLight>(world);
  }

  void prepare(PictureGeometry geometry, PreparedPicture::Implementation* picture) {
    picture->takeSurfaces();
    picture->scene = world_.geometry->scene;
    picture->visibility = std::move(geometry.visibility);
    picture->map_from_body = std::move(geometry.map_from_body);
    picture->ready.seen.surfaces = std::move(geometry.surfaces);
    const Visibility& visibility = *picture->visibility;
    const Geometry* const bodies = visibility.movingGeometry();
    picture->body_light = bodies ? body_light_ : nullptr;
    picture->views = bodies ? body_light_->look(*bodies, picture->visibility) : nullptr;
    makeReady({world_, visibility, picture->body_light.get(), gather_.get()}, &picture->ready);
  }

  std::size_t placesCast() const { return gather_ ? gather_->nodesCast() : 0; }

 private:
  World world_;
  std::shared_ptr<FinalGather> gather_;          ///< where it is asked for
  std::shared_ptr<const BodyLight> body_light_;  ///< where there are bodies
};

PreparedPicture::PreparedPicture() : implementation_(std::make_unique<Implementation>()) {}
PreparedPicture::~PreparedPicture() = default;
PreparedPicture::PreparedPicture(PreparedPicture&&) noexcept = default;
PreparedPicture& PreparedPicture::operator=(PreparedPicture&&) noexcept = default;

image::LinearImage PreparedPicture::illuminate(const Illumination& light) const {
  return implementation_->illuminate(light);
}
std::vector<image::LightOutside> PreparedPicture::lightsOutside(const Illumination& light,
                                                                float nearest_m) const {
  return implementation_->lightsOutside(light, nearest_m);
}
const Surfaces& PreparedPicture::surfaces() const {
  return implementation_->surfaces();
}
Surfaces PreparedPicture::takeSurfaces() {
  return implementation_->takeSurfaces();
}

PicturePreparer::PicturePreparer(const World& world, int final_gather, const PicturePreparer* beside)
    : implementation_(std::make_unique<Implementation>(world, final_gather,
                                                       beside ? beside->implementation_.get() : nullptr)) {}
PicturePreparer::~PicturePreparer() = default;

void PicturePreparer::prepare(PictureGeometry geometry, PreparedPicture* picture) {
  implementation_->prepare(std::move(geometry), picture->implementation_.get());
}
std::size_t PicturePreparer::placesCast() const {
  return implementation_->placesCast();
}

}  // namespace sunlit::light
