// Features of two pictures, checked against where their points truly lie.
#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/evaluate/picture.h"
#include "sunlit/evaluate/run/run_folder.h"
#include "sunlit/evaluate/verify/point_maps.h"
#include "sunlit/evaluate/verify/verified_file.h"
#include "sunlit/evaluate/verify/verify.h"
#include "sunlit/image/files.h"
#include "sunlit/studio/command_line.h"
#include "tools/evaluate_pair_options.h"

namespace sunlit::tools {
namespace {

using image::Rgb8Image;

evaluate::PointMaps mapsOf(const EvaluatePairOptions& options, const Rgb8Image& a, const Rgb8Image& b) {
  const evaluate::PictureSizes sizes{{a.width, a.height}, {b.width, b.height}};
  if (!options.homography.empty()) {
    const Eigen::Matrix3d homography = evaluate::readHomography(options.homography);
    try {
      return evaluate::homographyMaps(homography, sizes);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(options.homography + ": " + error.what());
    }
  }
  if (a.width != b.width || a.height != b.height) {
    throw std::invalid_argument(options.a + " is " + std::to_string(a.width) + "x" +
                                std::to_string(a.height) + " px, " + options.b + " " +
                                std::to_string(b.width) + "x" + std::to_string(b.height) +
                                " px: pictures of different sizes need --homography FILE");
  }
  return evaluate::identityMaps(sizes.a);
}

void print(const std::vector<evaluate::VerifiedRow>& rows) {
  std::size_t widest = 0;
  for (const evaluate::VerifiedRow& row : rows) widest = std::max(widest, row.detector.size());
  const int width = static_cast<int>(widest);
  std::printf("%-*s %13s %13s %7s %7s %17s %7s %7s %9s %7s %7s %8s\n", width, "", "features", "common",
              "repeat.", "score", "MMA@1/3/5", "mutual", "ratio", "precision", "recall", "AP", "D");
  for (const evaluate::VerifiedRow& row : rows) {
    const evaluate::Verified& v = row.verified;
    const auto& accuracy = v.matching_accuracy;
    std::printf("%-*s %6u/%6u %6zu/%6zu %7.3f %7.3f %5.3f/%5.3f/%5.3f %7zu %7u %9.3f %7.3f %7.3f %8.4f\n",
                width, row.detector.c_str(), v.difference.features_a, v.difference.features_b, v.common_a,
                v.common_b, v.repeatability, v.matching_score, accuracy[0], accuracy[2], accuracy[4],
                v.mutual_matches, v.difference.matches, v.precision, v.recall, v.average_precision,
                v.difference.value);
  }
}

void evaluatePair(const EvaluatePairOptions& options) {
  const std::string file = options.output + "/verified.csv";
  evaluate::requireNoRun(options.output);
  evaluate::requireNoneOfRun(file);
  Rgb8Image a = image::readPhotograph(options.a);
  Rgb8Image b = image::readPhotograph(options.b);
  const evaluate::PointMaps maps = mapsOf(options, a, b);
  evaluate::VerifyOptions verify = options.verify;
  verify.cache = evaluate::FeatureCache::usual(options.features_cache_gb, [](const std::string& line) {
    std::fprintf(stderr, "evaluate_pair: %s\n", line.c_str());
  });
  const std::vector<evaluate::Verified> verified =
      evaluate::verifyImages({evaluate::matOf(a), evaluate::matOf(b)}, maps, verify);
  std::vector<evaluate::VerifiedRow> rows;
  for (std::size_t i = 0; i < verified.size(); ++i)
    rows.push_back({options.a, options.b, options.verify.detectors[i], verified[i]});
  image::makeFolder(options.output);
  evaluate::writeVerified(file, rows);
  print(rows);
  std::printf("%s\n", file.c_str());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"evaluate_pair", argc, argv}, parseEvaluatePairOptions, evaluatePair);
}
