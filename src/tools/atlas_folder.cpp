#include "tools/atlas_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace sunlit::tools {

namespace fs = std::filesystem;

namespace {

/// Few enough that all files of observations are open at a time.
constexpr std::size_t kMostUnits = 500;
constexpr std::size_t kUsualPoses = 16;

std::size_t posesOfUnit(const AtlasRunOptions& options) {
  if (options.unit_poses > 0) return static_cast<std::size_t>(options.unit_poses);
  return std::max(kUsualPoses, (options.poses.size() + kMostUnits - 1) / kMostUnits);
}

std::size_t conditionsOfUnit(const AtlasRunOptions& options) {
  return options.unit_conditions > 0 ? static_cast<std::size_t>(options.unit_conditions)
                                     : options.conditions.size();
}

std::string nameOf(const AtlasRunOptions& options, const ObserveUnit& unit) {
  char name[64];
  std::snprintf(name, sizeof name, "poses_%07lld",
                static_cast<long long>(options.poses[unit.first_pose].number));
  const bool has_all = unit.end_condition - unit.first_condition == options.conditions.size();
  return name + (has_all ? "" : "_from_" + options.conditions[unit.first_condition].name);
}

}  // namespace

AtlasFolder::AtlasFolder(const AtlasRunOptions& options) : folder_(options.output) {
  for (const AtlasCondition& condition : options.conditions) conditions_.push_back(condition.name);
  const std::size_t poses = posesOfUnit(options), lights = conditionsOfUnit(options);
  for (std::size_t p = 0; p < options.poses.size(); p += poses) {
    for (std::size_t c = 0; c < conditions_.size(); c += lights) {
      ObserveUnit unit{p, std::min(p + poses, options.poses.size()), c,
                       std::min(c + lights, conditions_.size()), ""};
      unit.file = observations() + '/' + nameOf(options, unit) + ".bin";
      observe_units_.push_back(unit);
    }
  }
  for (const std::string& method : options.atlas.verify.detectors) {
    for (const std::string& condition : conditions_) compare_units_.push_back({condition, method});
  }
}

std::string AtlasFolder::cellsOf(const CompareUnit& unit) const {
  return folder_ + "/cells/" + unit.method + '/' + unit.map;
}

std::string AtlasFolder::cell(const evaluate::AtlasCellKey& key) const {
  return cellsOf({key.map, key.method}) + '/' + key.query + ".csv";
}

bool AtlasFolder::isObserved(const ObserveUnit& unit) const {
  return fs::exists(unit.file);
}

std::vector<std::string> AtlasFolder::missingQueries(const CompareUnit& unit) const {
  std::vector<std::string> missing;
  for (const std::string& query : conditions_) {
    if (!fs::exists(cell({unit.map, query, unit.method}))) missing.push_back(query);
  }
  return missing;
}

std::size_t AtlasFolder::cellsMissing() const {
  std::size_t missing = 0;
  for (const CompareUnit& unit : compare_units_) missing += missingQueries(unit).size();
  return missing;
}

std::size_t AtlasFolder::unitsMissing() const {
  return static_cast<std::size_t>(std::count_if(observe_units_.begin(), observe_units_.end(),
                                                [&](const ObserveUnit& unit) { return !isObserved(unit); }));
}

double AtlasFolder::bytes() const {
  double bytes = 0.0;
  std::error_code error;  // no such folder: nothing; a file that just goes: nothing
  for (const std::string& part : {observations(), file("cells")}) {
    for (const auto& entry : fs::recursive_directory_iterator(part, error)) {
      if (entry.is_regular_file(error)) bytes += static_cast<double>(entry.file_size(error));
    }
  }
  return bytes;
}

UnitLock::UnitLock(const std::string& file)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) throw std::runtime_error(file + ": cannot be opened: " + std::strerror(errno));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;  // not all systems can
  ::close(descriptor_);
  throw std::runtime_error(file + ": another process is at it");
}

UnitLock::~UnitLock() {
  ::close(descriptor_);
}

}  // namespace sunlit::tools
