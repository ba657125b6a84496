#include "sunlit/evaluate/features/detector_plugin.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "sunlit/quantity/one_line.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

const std::set<int> kNormsOfBits = {cv::NORM_HAMMING, cv::NORM_HAMMING2};
const std::set<int> kNormsOfNumbers = {cv::NORM_L1, cv::NORM_L2};

/// What `work` throws, of whatever type, as an `Error` of one line that begins with the name.
template <typename Error, typename Work>
auto named(const std::string& name, const Work& work) -> decltype(work()) {
  std::string why = "throws what is no std::exception";
  try {
    return work();
  } catch (const cv::Exception& error) {
    why = error.err;
  } catch (const std::exception& error) {
    why = error.what();
  } catch (...) {
  }
  throw Error("detector " + name + ": " + oneLine(why));
}

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

void requirePoints(const std::vector<cv::KeyPoint>& points, const cv::Size& size) {
  for (const cv::KeyPoint& point : points) {
    const bool is_inside = point.pt.x >= -0.5F && static_cast<double>(point.pt.x) < size.width - 0.5 &&
                           point.pt.y >= -0.5F && static_cast<double>(point.pt.y) < size.height - 0.5;
    if (!is_inside) {
      fail("gives the key point (" + textOf(point.pt.x, 6) + ", " + textOf(point.pt.y, 6) +
           "), outside the picture of " + std::to_string(size.width) + "×" + std::to_string(size.height) +
           " px");
    }
  }
}

void requireDescriptors(const cv::Mat& descriptors, std::size_t points, int norm) {
  if (static_cast<std::size_t>(descriptors.rows) != points) {
    fail("gives " + std::to_string(descriptors.rows) + " descriptors of " + std::to_string(points) +
         " key points");
  }
  if (points == 0) return;
  const bool is_right =
      descriptors.type() == CV_8UC1 || (descriptors.type() == CV_32FC1 && kNormsOfBits.count(norm) == 0);
  if (descriptors.dims != 2 || !is_right) {
    fail("gives descriptors of OpenCV type " + cv::typeToString(descriptors.type()) + ", but must give " +
         (kNormsOfBits.count(norm) > 0 ? "CV_8UC1" : "CV_8UC1 or CV_32FC1"));
  }
  if (!cv::checkRange(descriptors)) fail("gives descriptors that are no finite numbers");
}

class PluginWorker : public cv::Feature2D {
 public:
  PluginWorker(std::string name, std::shared_ptr<DetectorPlugin> plugin, int norm)
      : name_(std::move(name)), plugin_(std::move(plugin)), norm_(norm) {}
  cv::String getDefaultName() const override { return name_; }
  int defaultNorm() const override { return norm_; }
  bool empty() const override { return false; }

  void detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                        cv::OutputArray descriptors, bool use_provided_keypoints) override {
    CV_Assert(!use_provided_keypoints && mask.empty() && image.type() == CV_8UC1);
    const cv::Mat grey = image.getMat();
    const cv::Mat found = named<std::runtime_error>(name_, [&] {
      keypoints = plugin_->detect(grey);
      requirePoints(keypoints, grey.size());
      const cv::Mat rows = keypoints.empty() ? cv::Mat() : plugin_->describe(grey, keypoints);
      requirePoints(keypoints, grey.size());
      requireDescriptors(rows, keypoints.size(), norm_);
      return rows;
    });
    descriptors.assign(found);
  }

 private:
  std::string name_;
  std::shared_ptr<DetectorPlugin> plugin_;
  int norm_;
};

class PluginDetector : public Detector {
 public:
  PluginDetector(std::string name, DetectorPluginFactory make)
      : name_(std::move(name)), make_(std::move(make)), plugin_(made()) {
    requireKeys(fields());
    requireNorm(norm());
  }
  std::unique_ptr<Detector> clone() const override {
    auto copy = std::make_unique<PluginDetector>(name_, make_);
    take(copy->fields());
    return copy;
  }
  std::vector<Field> fields() override {
    return named<std::invalid_argument>(name_, [&] { return plugin_->fields(); });
  }
  int norm() const override {
    return named<std::invalid_argument>(name_, [&] { return plugin_->norm(); });
  }
  cv::Ptr<cv::Feature2D> make() const override {
    const std::shared_ptr<DetectorPlugin> plugin = made();
    take(named<std::invalid_argument>(name_, [&] { return plugin->fields(); }));
    const int by = named<std::invalid_argument>(name_, [&] { return plugin->norm(); });
    requireNorm(by);
    return cv::makePtr<PluginWorker>(name_, plugin, by);
  }
  std::string version() const override {
    const std::string version = named<std::invalid_argument>(name_, [&] { return plugin_->version(); });
    return version.empty() ? "" : name_ + " " + version;
  }

 private:
  std::shared_ptr<DetectorPlugin> made() const {
    return named<std::invalid_argument>(name_, [&] {
      auto plugin = make_();
      if (!plugin) fail("cannot be made");
      return plugin;
    });
  }
  /// The values that these parameters have.
  void take(const std::vector<Field>& rows) const {
    for (const Field& row : named<std::invalid_argument>(name_, [&] { return plugin_->fields(); }))
      fieldOf(rows, row.key).set(row.value(), row.key);
  }
  void requireKeys(const std::vector<Field>& rows) const {
    std::set<std::string> taken = {"type", "preprocessing", ""};
    for (const std::string& name : preprocessingNames()) taken.insert(name);
    for (const Field& row : rows) {
      const bool is_word =
          row.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
      if (!is_word || !taken.insert(row.key).second)
        refuse("detector " + name_ + ": a parameter", '"' + row.key + '"',
               "a word of small letters, digits and _, given once, none of [type, preprocessing], and no "
               "preprocessing");
    }
  }
  void requireNorm(int by) const {
    if (kNormsOfBits.count(by) + kNormsOfNumbers.count(by) == 0)
      refuse("detector " + name_ + ": its norm", std::to_string(by),
             "cv::NORM_L1, NORM_L2, NORM_HAMMING or NORM_HAMMING2");
  }

  std::string name_;
  DetectorPluginFactory make_;
  std::shared_ptr<DetectorPlugin> plugin_;  // holds the parameters, and finds nothing itself
};

}  // namespace

std::unique_ptr<Detector> makePluginDetector(const std::string& name, DetectorPluginFactory make) {
  return std::make_unique<PluginDetector>(name, std::move(make));
}

}  // namespace sunlit::evaluate
