#include "light/patches/mirror_sky.h"

#include <tbb/parallel_for.h>

#include "light/patches/mirror_places.h"

namespace sunlit::light {

MirrorSky::MirrorSky(const sky::Daylight& day)
    : patches_(SkyPatches::luminances(day, SkyPatches::Weight::kEven)),
      table_(kMirrorPlaces, Eigen::Array4f::Zero()) {
  const MirrorPlaces& sky = mirrorPlaces();
  tbb::parallel_for(std::size_t{0}, kMirrorLevels[0].cells(), [&](std::size_t place) {
    if (sky.below[place]) return;
    const Eigen::Array3f light = day.skyLuminance(sky::octahedralMiddle(kMirrorLevels[0].side, place)).value;
    table_[place] = Eigen::Array4f(light[0], light[1], light[2], 0.0f);
  });
  for (std::size_t level = 1; level < kMirrorLevels.size(); ++level) {
    tbb::parallel_for(std::size_t{0}, kMirrorLevels[level].cells(), [&](std::size_t cell) {
      const std::size_t place = kMirrorLevels[level].first + cell;
      if (sky.below[place]) return;
      Eigen::Array4f sum = Eigen::Array4f::Zero();
      float above = 0.0f;
      for (const std::uint16_t tap : sky.taps[place]) {
        if (sky.below[tap]) continue;
        sum += table_[tap];
        above += 1.0f;
      }
      if (above > 0.0f) table_[place] = sum / above;
    });
  }
}

}  // namespace sunlit::light
