/// Evaluations of small pictures by cheap differences.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "sunlit/evaluate/run/evaluation.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {

constexpr std::int64_t kFrameNs = 100000000;

inline std::int64_t stampOf(std::int64_t pose) {
  return 5000 * kFrameNs + pose * kFrameNs;
}

inline cv::Mat picture(std::int64_t pose, std::size_t stream, cv::Size size = {32, 24}) {
  cv::Mat image(size, CV_8UC3);
  cv::RNG(static_cast<std::uint64_t>(100 * pose) + stream + 1).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

inline EvaluationOptions optionsFor(const TemporaryFolder& folder) {
  EvaluationOptions options;
  options.streams = {"h04", "h12", "h20"};
  options.output_dir = folder.file("out");
  options.comparer.differences = {"boolean_rgb", "euclidean_grey"};
  return options;
}

inline void feedPose(Evaluation& evaluation, std::int64_t pose) {
  for (std::size_t s = 0; s < evaluation.options().streams.size(); ++s) {
    evaluation.addImage(s, stampOf(pose), picture(pose, s));
  }
}

/// What a run notes is added to `notes`, a line each.
inline EvaluationCallbacks notingTo(std::string* notes) {
  EvaluationCallbacks callbacks;
  callbacks.note = [notes](const std::string& line) { *notes += line + "\n"; };
  return callbacks;
}

inline bool hasLine(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line) != std::string::npos;
}

}  // namespace sunlit::evaluate
