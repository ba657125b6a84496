#include "sunlit/ros/star_light.h"

#include "sunlit/astronomy/star_catalogue.h"

namespace sunlit::ros_interface {

StarLight loadStars() {
  const astronomy::StarCatalogue catalogue = astronomy::readStarCatalogue();
  auto stars = std::make_shared<std::vector<sky::Star>>();
  stars->reserve(catalogue.stars.size());
  for (const astronomy::CatalogueStar& star : catalogue.stars)
    stars->push_back({star.towards.cast<float>(), sky::starIlluminance(star.v_magnitude, star.b_minus_v)});
  return {stars, catalogue.warnings};
}

}  // namespace sunlit::ros_interface
