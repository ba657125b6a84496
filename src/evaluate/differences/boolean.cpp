#include "evaluate/differences/built_in.h"
#include "evaluate/differences/pixel_sums.h"

namespace sunlit::evaluate {
namespace {

class Boolean : public Difference {
 public:
  explicit Boolean(Channels channels) : channels_(channels) {}
  std::unique_ptr<Difference> clone() const override { return std::make_unique<Boolean>(*this); }
  DifferenceValue between(const View& a, const View& b, const Matching&, const StopToken&) const override {
    const PixelSums sums = sumsOf(imageOf(a, channels_), imageOf(b, channels_));
    return sameBothWays(static_cast<double>(sums.unequal) / static_cast<double>(sums.pixels));
  }

 private:
  Channels channels_;
};

}  // namespace

std::unique_ptr<Difference> makeBoolean(Channels channels) {
  return std::make_unique<Boolean>(channels);
}

}  // namespace sunlit::evaluate
