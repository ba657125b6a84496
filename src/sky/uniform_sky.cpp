#include "sunlit/sky/uniform_sky.h"

#include "sky_table.h"
#include "sunlit/quantity/range.h"

namespace sunlit::sky {

Daylight uniformDaylight(const UniformSky& sky) {
  require("ground_albedo", sky.ground_albedo, {0.0, 1.0});
  for (const float value : sky.luminance.value) {
    require("luminance", static_cast<double>(value), {0.0, 1e12}, "cd/m²");
  }
  auto table = std::make_shared<SkyTable>();
  table->even = sky.luminance.value;
  table->sun = sky.sun;
  gatherIlluminance(static_cast<float>(sky.ground_albedo), table.get());
  return Daylight(table);
}

}  // namespace sunlit::sky
