// A path at every time of the day, and what a map of each is worth at each other.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/evaluate/atlas/atlas_files.h"
#include "sunlit/evaluate/files/report.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/duration.h"
#include "sunlit/studio/command_line.h"
#include "tools/atlas_estimate.h"
#include "tools/atlas_folder.h"
#include "tools/atlas_observe.h"
#include "tools/atlas_options.h"
#include "tools/atlas_slurm.h"
#include "tools/output_folder.h"
#include "tools/progress_line.h"
#include "tools/recipe.h"

namespace sunlit::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// How much of a stage is done.
class StageProgress {
 public:
  StageProgress(std::string work, std::size_t all) : work_(std::move(work)), all_(all) {}
  void step() {
    ++done_;
    const double share = static_cast<double>(done_) / static_cast<double>(all_);
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    line_.show(work_, share, spent_s / share - spent_s);
  }

 private:
  std::string work_;
  std::size_t all_;
  std::size_t done_ = 0;
  Clock::time_point begin_ = Clock::now();
  ProgressLine line_;
};

/// Comparing reads from all observations at once. Throws std::runtime_error where a process may not have so
/// many files open, before hours are spent on them.
void requireOpenFiles(const std::string& folder, std::size_t count) {
  constexpr rlim_t kOthers = 100;
  rlimit limit{};
  const rlim_t wanted = count + kOthers;
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return;
  if (limit.rlim_max >= wanted) {
    limit.rlim_cur = wanted;
    if (::setrlimit(RLIMIT_NOFILE, &limit) == 0) return;
  }
  throw std::runtime_error(folder + ": would be " + std::to_string(count) +
                           " units of observations, but a process may have no more than " +
                           std::to_string(limit.rlim_max) +
                           " files open here (ulimit -n); take larger --unit-poses or --unit-conditions");
}

/// A run of the program on one folder.
class Atlas {
 public:
  explicit Atlas(const AtlasRunOptions& options)
      : options_(options), folder_(options), recipe_(options.output, "atlas", options.recipe) {
    recipe_.requireNoStranger(anythingIn(options.output));
    requireOpenFiles(options.output, folder_.observeUnits().size());
  }

  /// Makes the world and its lights, and says what all will take. Throws where that cannot be.
  void estimate() {
    camera_ = std::make_unique<AtlasCamera>(options_);
    tellAndRequireRoom(options_, folder_, estimateOf(options_, measureCost(options_, camera_.get())));
  }

  void submit() {
    estimate();
    recipe_.note(camera_->fingerprint());
    runBySlurm(options_, folder_);
  }

  void observe() {
    std::vector<const ObserveUnit*> wanted;
    std::size_t poses = 0;
    for (std::size_t u = 0; u < folder_.observeUnits().size(); ++u) {
      const ObserveUnit& unit = folder_.observeUnits()[u];
      if (!options_.shard.has(u) || folder_.isObserved(unit)) continue;
      wanted.push_back(&unit);
      poses += posesMissing(options_, unit);
    }
    if (wanted.empty()) return;
    estimate();
    recipe_.note(camera_->fingerprint());
    image::makeFolder(folder_.observations());
    camera_->writeLights(folder_.lights());
    StageProgress progress("observing " + std::to_string(poses) + " poses", poses);
    for (const ObserveUnit* unit : wanted)
      observeUnit(options_, *unit, camera_.get(), [&] { progress.step(); });
    camera_->blindPoses().tell();
  }

  void compare() {
    std::vector<const CompareUnit*> wanted;
    std::size_t cells = 0;
    for (std::size_t u = 0; u < folder_.compareUnits().size(); ++u) {
      const std::size_t missing = folder_.missingQueries(folder_.compareUnits()[u]).size();
      if (!options_.shard.has(u) || missing == 0) continue;
      wanted.push_back(&folder_.compareUnits()[u]);
      cells += missing;
    }
    if (wanted.empty()) return;
    std::vector<std::unique_ptr<evaluate::ObservationFile>> files;
    const evaluate::DriveIndex index(openObservations(&files),
                                     [](const evaluate::ObservationKey& key) { return key.pose; });
    StageProgress progress("comparing " + std::to_string(cells) + " cells", cells);
    for (const CompareUnit* unit : wanted) {
      const evaluate::AtlasMap map(index, options_.atlas, {unit->map, "", unit->method});
      image::makeFolder(folder_.cellsOf(*unit));
      for (const std::string& query : folder_.missingQueries(*unit)) {
        evaluate::writeAtlasRows(folder_.cell({unit->map, query, unit->method}), map.find(query));
        progress.step();
      }
    }
  }

  void merge() {
    if (const std::size_t missing = folder_.cellsMissing(); missing > 0)
      throw std::runtime_error(options_.output + ": " + std::to_string(missing) +
                               " cells are missing; --stage compare makes them");
    image::removeUnfinished(options_.output);
    std::vector<evaluate::AtlasCellKey> keys;
    for (const CompareUnit& unit : folder_.compareUnits()) {
      for (const AtlasCondition& query : options_.conditions)
        keys.push_back({unit.map, query.name, unit.method});
    }
    const evaluate::AtlasSummary summary =
        evaluate::summariseAtlas(keys, [&](const evaluate::AtlasCellKey& key) { return folder_.cell(key); });
    evaluate::writeAtlas(folder_.file("atlas.csv"), summary.cells);
    writeConditions(summary);
    std::printf("%s\n", folder_.file("atlas.csv").c_str());
    std::fflush(stdout);
    if (options_.draws) draw();
  }

 private:
  std::vector<const evaluate::ObservationFile*> openObservations(
      std::vector<std::unique_ptr<evaluate::ObservationFile>>* files) const {
    if (const std::size_t missing = folder_.unitsMissing(); missing > 0)
      throw std::runtime_error(options_.output + ": " + std::to_string(missing) + " of " +
                               std::to_string(folder_.observeUnits().size()) +
                               " units are not observed yet; --stage observe does it");
    std::vector<const evaluate::ObservationFile*> opened;
    for (const ObserveUnit& unit : folder_.observeUnits()) {
      files->push_back(
          std::make_unique<evaluate::ObservationFile>(unit.file, evaluate::ObservationUse::kRead));
      opened.push_back(files->back().get());
    }
    return opened;
  }

  /// What the lights are, and what pictures were taken with in each.
  void writeConditions(const evaluate::AtlasSummary& summary) const {
    std::ifstream lights(folder_.lights());
    std::string text, line;
    for (std::size_t i = 0; std::getline(lights, line); ++i) {
      const std::string name = line.substr(0, line.find(','));
      char ev100[32] = "ev100_mean";
      if (i > 0) std::snprintf(ev100, sizeof ev100, "%.6f", summary.ev100.at(name));
      text += line + ',' + ev100 + '\n';
    }
    if (text.empty()) throw std::runtime_error(folder_.lights() + ": cannot be read");
    image::writeFileAtomically(folder_.file("conditions.csv"), text);
  }

  void draw() const {
    if (evaluate::drawReport(options_.output, evaluate::ReportTables::kShown)) return;
    throw std::runtime_error(options_.output +
                             ": all is computed, but the heat maps were not drawn; rosrun sunlit report " +
                             options_.output + " does it");
  }

  const AtlasRunOptions& options_;
  AtlasFolder folder_;
  FolderRecipe recipe_;
  std::unique_ptr<AtlasCamera> camera_;
};

void run(const AtlasRunOptions& options) {
  Atlas atlas(options);
  if (options.estimate) return atlas.estimate();
  if (options.slurm) return atlas.submit();
  if (options.stage == AtlasStage::kObserve) return atlas.observe();
  if (options.stage == AtlasStage::kCompare) return atlas.compare();
  if (!options.merge && AtlasFolder(options).cellsMissing() > 0) {
    atlas.observe();
    atlas.compare();
  }
  atlas.merge();
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"atlas", argc, argv}, parseAtlasOptions, run);
}
