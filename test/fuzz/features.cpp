// Kept features. The checksum is made right, for a wrong one ends all reading at once.
#include <cstring>
#include <opencv2/core.hpp>

#include "fuzz/reader.h"
#include "sunlit/evaluate/features/feature_cache.h"
#include "sunlit/image/content_hash.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {
namespace {

constexpr std::size_t kChecksumAt = 32, kHeader = 48;
const std::string kKey = "0123456789abcdef0123456789abcdef";

std::string fileOf(int type) {
  const TemporaryFolder folder;
  evaluate::Features features;
  features.key_points = {cv::KeyPoint(3.0F, 4.0F, 1.0F), cv::KeyPoint(5.0F, 6.0F, 1.0F)};
  features.descriptors = cv::Mat::ones(2, 8, type);
  evaluate::FeatureCache(folder.path(), 1000000).keep(kKey, features);
  return contentOf(folder.file(kKey + ".features"));
}

}  // namespace

std::vector<std::string> seeds() {
  return {fileOf(CV_32F), fileOf(CV_8U)};
}

void read(const std::string& input) {
  std::string file = input;
  if (file.size() >= kHeader) {
    image::ContentHash hash;
    hash.addBytes(kKey.data(), kKey.size());
    hash.addBytes(file.data(), kChecksumAt);
    hash.addBytes(file.data() + kHeader, file.size() - kHeader);
    const image::ContentHash::Number number = hash.number();
    std::memcpy(file.data() + kChecksumAt, &number, sizeof(number));
  }
  setContent("./kept/" + kKey + ".features", file);
  evaluate::FeatureCache cache("kept", 1000000);
  const auto found = cache.find(kKey);
  if (found && found->descriptors.rows != static_cast<int>(found->key_points.size()))
    throw std::logic_error("features without as many descriptors were found");
}

std::string named() {
  return "kept";
}

}  // namespace sunlit::fuzz
