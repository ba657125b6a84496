#include "evaluate/features/detectors.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

enum class Descriptor { kKazeUpright, kKaze, kMldbUpright, kMldb };

/// cv::AKAZE.
class Akaze : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Akaze>(*this); }
  std::string version() const override { return "akaze"; }
  std::vector<Field> fields() override {
    return {{"descriptor_type",
             choiceOf(&descriptor_type_, {"kaze_upright", "kaze", "mldb_upright", "mldb"}),
             "",
             {},
             "kaze: numbers; mldb: bits; upright: no orientation"},
            {"descriptor_size",
             &descriptor_size_,
             "bit",
             {0, 3 * kMostBitsAChannel},
             "of mldb; 0: all; at most 162 a channel"},
            {"descriptor_channels", &descriptor_channels_, "", {1, 3}, "of mldb: grey levels, gradients"},
            {"threshold", &threshold_, "", {0, 1}, "that the determinant of the Hessian exceeds"},
            {"n_octaves", &n_octaves_, "", {1, 8}, "doublings of the scale"},
            {"n_octave_layers", &n_octave_layers_, "", {1, 16}, "layers of an octave"},
            {"diffusivity", choiceOf(&diffusivity_, kDiffusivities), "", {}, kDiffusivityDoc}};
  }
  int norm() const override {
    const bool is_bits = descriptor_type_ >= Descriptor::kMldbUpright;
    return is_bits ? cv::NORM_HAMMING : cv::NORM_L2;
  }
  cv::Ptr<cv::Feature2D> make() const override {
    require("descriptor_size of AKAZE", descriptor_size_,
            {0.0, static_cast<double>(kMostBitsAChannel * descriptor_channels_)}, "bit");
    static constexpr cv::AKAZE::DescriptorType kTypes[] = {
        cv::AKAZE::DESCRIPTOR_KAZE_UPRIGHT, cv::AKAZE::DESCRIPTOR_KAZE, cv::AKAZE::DESCRIPTOR_MLDB_UPRIGHT,
        cv::AKAZE::DESCRIPTOR_MLDB};
    return cv::AKAZE::create(kTypes[static_cast<int>(descriptor_type_)], descriptor_size_,
                             descriptor_channels_, static_cast<float>(threshold_), n_octaves_,
                             n_octave_layers_, diffusivity_);
  }

 private:
  /// Pairs among the cells of grids of 2 x 2, 3 x 3 and 4 x 4: 6 + 36 + 120.
  static constexpr int kMostBitsAChannel = 162;

  Descriptor descriptor_type_ = Descriptor::kMldb;
  int descriptor_size_ = 0;
  int descriptor_channels_ = 3;
  double threshold_ = 0.001;
  int n_octaves_ = 4;
  int n_octave_layers_ = 4;
  cv::KAZE::DiffusivityType diffusivity_ = cv::KAZE::DIFF_PM_G2;
};

}  // namespace

std::unique_ptr<Detector> makeAkaze() {
  return std::make_unique<Akaze>();
}

}  // namespace sunlit::evaluate
