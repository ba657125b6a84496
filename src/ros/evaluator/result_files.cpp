#include "ros/evaluator/result_files.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sunlit::ros_interface {
namespace {

constexpr const char* kTruth = "truth_";
constexpr const char* kEstimate = "estimate_";
constexpr const char* kOdometry = "odometry_";
constexpr const char* kTrajectoryEnding = ".tum";

bool isResult(const std::filesystem::path& file) {
  const std::string name = file.filename();
  if (name == kLocalisationTable || name == kOdometryTable) return true;
  if (file.extension() != kTrajectoryEnding) return false;
  for (const char* beginning : {kTruth, kEstimate, kOdometry})
    if (name.rfind(beginning, 0) == 0) return true;
  return false;
}

}  // namespace

std::string truthFile(const BagStream& stream) {
  return kTruth + stream.fileName() + kTrajectoryEnding;
}

std::string estimateFile(const BagStream& stream, const std::string& detector) {
  return kEstimate + stream.fileName() + "_" + detector + kTrajectoryEnding;
}

std::string odometryFile(const BagStream& stream, const std::string& detector) {
  return kOdometry + stream.fileName() + "_" + detector + kTrajectoryEnding;
}

void requireOnlyOwnResults(const std::string& folder, const std::set<std::string>& own) {
  std::set<std::string> others;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();
    if (isResult(entry.path()) && own.count(name) == 0) others.insert(name);
  }
  if (error) throw std::runtime_error(folder + ": is no folder that can be written: " + error.message());
  if (others.empty()) return;
  throw std::invalid_argument(folder + ": this folder holds results of another run (" + *others.begin() +
                              (others.size() > 1 ? ", …" : "") +
                              "), which would be mixed with those of this one; choose another, or remove "
                              "them");
}

}  // namespace sunlit::ros_interface
