#include "evaluate/differences/built_in.h"
#include "evaluate/differences/pixel_sums.h"

namespace sunlit::evaluate {
namespace {

class Euclidean : public Difference {
 public:
  explicit Euclidean(Channels channels) : channels_(channels) {}
  std::unique_ptr<Difference> clone() const override { return std::make_unique<Euclidean>(*this); }
  DifferenceValue between(const View& a, const View& b, const Matching&, const StopToken&) const override {
    constexpr double kFullScale = 255.0 * 255.0;
    const PixelSums sums = sumsOf(imageOf(a, channels_), imageOf(b, channels_));
    const double full = imageOf(a, channels_).channels() * kFullScale * static_cast<double>(sums.pixels);
    return sameBothWays(static_cast<double>(sums.squares) / full);
  }

 private:
  Channels channels_;
};

}  // namespace

std::unique_ptr<Difference> makeEuclidean(Channels channels) {
  return std::make_unique<Euclidean>(channels);
}

}  // namespace sunlit::evaluate
