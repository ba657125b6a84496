/// By which way light of a distant disc comes to surfaces.
#pragma once

#include <cstdint>

#include "sunlit/light/visibility.h"

namespace sunlit::light {

class DiscWay {
 public:
  virtual ~DiscWay() = default;
  /// Sets stopped[i] to 1 where no light comes along ray i, which starts at a surface, else to 0. May be
  /// called by many threads.
  virtual void stopped(const Rays& rays, std::uint8_t* stopped) const = 0;
};

class StraightWay : public DiscWay {
 public:
  /// Keeps a reference. What glass and what blends take of the light is not told.
  explicit StraightWay(const Visibility& visibility) : visibility_(visibility) {}
  void stopped(const Rays& rays, std::uint8_t* stopped) const override {
    visibility_.occluded(rays, stopped, Visibility::Blends::kLetPass);
  }

 private:
  const Visibility& visibility_;
};

}  // namespace sunlit::light
