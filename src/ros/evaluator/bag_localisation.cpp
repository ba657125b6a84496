#include "ros/evaluator/bag_localisation.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "ros/evaluator/bag_views.h"
#include "ros/evaluator/folder_lock.h"
#include "ros/evaluator/progress_log.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/trajectory/trajectory.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::ros_interface {
namespace {

using evaluate::LocalisationRow;

/// Views that are in memory at once: enough for all processors, few enough for any memory.
constexpr std::size_t kViewsAtOnce = 16;
constexpr std::size_t kProblemsShown = 5;

/// A line for each query stream and detector.
std::string localisationTable(const std::vector<evaluate::LocalisationSummary>& summaries) {
  std::string table = "map      query    detector      n  failed";
  char buffer[200];
  for (const evaluate::Reach& reach : evaluate::kReaches) {
    std::snprintf(buffer, sizeof buffer, "  %5.4g m %2.4g deg", reach.metres, reach.degrees);
    table += buffer;
  }
  table += "  median m    deg  AUC@5/10/20 deg";
  for (const evaluate::LocalisationSummary& s : summaries) {
    std::snprintf(buffer, sizeof buffer, "\n%-8s %-8s %-9s %5zu  %6zu", s.map.c_str(), s.query.c_str(),
                  s.detector.c_str(), s.n, s.failures);
    table += buffer;
    for (const evaluate::Statistics& within : s.within) {
      std::snprintf(buffer, sizeof buffer, "  %12.1f %%", 100.0 * within.mean);
      table += buffer;
    }
    std::snprintf(buffer, sizeof buffer, "  %8.3f %6.3f  %.3f/%.3f/%.3f", s.median_error_m,
                  s.median_error_deg, s.auc[0], s.auc[1], s.auc[2]);
    table += buffer;
  }
  return table;
}

class BagLocalisation {
 public:
  explicit BagLocalisation(const BagLocalisationOptions& options)
      : options_(options),
        streams_(localisationStreams(options.maps, options.queries, options.name_space)),
        localisation_(options.localisation),
        map_name_(namesOf(streams_.map)) {}

  int run() {
    for (const BagStream& stream : streams_.map) addToMap(stream);
    tellMap();
    localisation_.finishMap();
    for (const BagStream& stream : streams_.queries) find(stream);
    if (rows_.empty()) throw std::runtime_error("no query can be used: " + firstProblems());
    const std::vector<evaluate::LocalisationSummary> summaries = summariesOf(rows_);
    writeLocalisation(fileOf("localisation.csv"), rows_);
    writeLocalisationSummary(fileOf("localisation_summary.csv"), summaries);
    writeLocalisationProblems(fileOf("localisation_problems.csv"), problems_);
    std::printf("\n%s\n%s\n", localisationTable(summaries).c_str(), fileOf("localisation.csv").c_str());
    if (problems_.empty()) return 0;
    std::fprintf(stderr, "%s\n", firstProblems().c_str());
    return kNotWholeStatus;
  }

 private:
  static std::string namesOf(const std::vector<BagStream>& streams) {
    std::string names;
    for (const BagStream& stream : streams) names += (names.empty() ? "" : "+") + stream.name;
    return names;
  }

  std::string fileOf(const std::string& name) const { return options_.output_dir + "/" + name; }

  std::unique_ptr<BagViews> opened(const BagStream& stream) const {
    std::printf("reading %s of %s\n", stream.name.c_str(), stream.bag.c_str());
    std::fflush(stdout);
    auto views = std::make_unique<BagViews>(stream, options_.name_space, options_.intake);
    if (views->repeated() > 0)
      std::printf("%s: %zu images left out, whose stamps repeat\n", stream.name.c_str(), views->repeated());
    return views;
  }

  void addProblem(const BagStream& stream, bool is_of_map, std::int64_t stamp_ns, const std::string& fault) {
    problems_.push_back({stream.name, is_of_map, stamp_ns, fault});
  }

  /// Calls work(entries, views) for `entries`, a few at a time; those that cannot be read are problems.
  template <typename Work>
  void forEach(const BagViews& views, const std::vector<std::size_t>& entries, bool is_of_map, Work work) {
    WorkLog log(is_of_map ? "key frames made" : "queries localised", entries.size());
    for (std::size_t first = 0; first < entries.size(); first += kViewsAtOnce) {
      std::vector<std::size_t> which;
      std::vector<evaluate::PosedView> read;
      for (std::size_t i = first; i < std::min(first + kViewsAtOnce, entries.size()); ++i) {
        BagViews::Read one = views.read(entries[i], is_of_map);
        if (one.fault.empty()) {
          which.push_back(entries[i]);
          read.push_back(one.view);
        } else {
          addProblem(views.stream(), is_of_map, views.entries()[entries[i]].stamp_ns, one.fault);
        }
      }
      work(which, read);
      log.update(std::min(first + kViewsAtOnce, entries.size()));
    }
  }

  void addToMap(const BagStream& stream) {
    const auto bag = opened(stream);
    const BagViews& views = *bag;
    evaluate::KeyFrameSpacing spacing(options_.localisation.map_every_m);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < views.entries().size(); ++i) {
      const BagViews::Entry& entry = views.entries()[i];
      const std::string fault = entry.fault.empty() && !entry.has_depth ? BagViews::kNoDepth : entry.fault;
      if (!fault.empty()) {
        addProblem(stream, true, entry.stamp_ns, fault);
      } else if (spacing.takes(entry.map_from_optical.translation())) {
        chosen.push_back(i);
      }
    }
    forEach(views, chosen, true, [&](const auto&, const auto& read) { localisation_.addKeyFrames(read); });
  }

  void tellMap() const {
    for (const evaluate::MapSize& size : localisation_.mapSizes()) {
      if (size.key_frames == 0) throw std::runtime_error("the map has no key frame: " + firstProblems());
      std::printf("map %s, %s: %zu key frames with %zu points, %.1f MB (%.0f kB a key frame)\n",
                  map_name_.c_str(), size.detector.c_str(), size.key_frames, size.points,
                  static_cast<double>(size.bytes) / 1e6,
                  static_cast<double>(size.bytes) / 1e3 / static_cast<double>(size.key_frames));
    }
  }

  void find(const BagStream& stream) {
    const auto bag = opened(stream);
    const BagViews& views = *bag;
    std::vector<std::size_t> usable;
    for (std::size_t i = 0; i < views.entries().size(); ++i) {
      const BagViews::Entry& entry = views.entries()[i];
      if (entry.fault.empty()) {
        usable.push_back(i);
      } else {
        addProblem(stream, false, entry.stamp_ns, entry.fault);
      }
    }
    const std::size_t first_row = rows_.size();
    forEach(views, usable, false, [&](const auto& which, const auto& read) {
      const auto results = localisation_.localise(read);
      for (std::size_t q = 0; q < which.size(); ++q) addRows(views, which[q], results[q]);
    });
    writeTrajectories(views, usable, first_row);
  }

  void addRows(const BagViews& views, std::size_t number,
               const std::vector<evaluate::LocalisedQuery>& results) {
    const BagViews::Entry& entry = views.entries()[number];
    for (std::size_t d = 0; d < results.size(); ++d) {
      rows_.push_back({entry.pose, entry.stamp_ns, map_name_, views.stream().name,
                       options_.localisation.detectors[d], results[d]});
    }
  }

  static evaluate::StampedPose poseOfLink(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical) {
    const Eigen::Isometry3d map_from_link = map_from_optical * linkFromOptical().inverse();
    return {stamp_ns, map_from_link.translation(), Eigen::Quaterniond(map_from_link.linear())};
  }

  void writeTrajectories(const BagViews& views, const std::vector<std::size_t>& usable,
                         std::size_t first_row) const {
    const std::string& name = views.stream().name;
    evaluate::Trajectory truth;
    for (const std::size_t i : usable)
      truth.push_back(poseOfLink(views.entries()[i].stamp_ns, views.entries()[i].map_from_optical));
    writeTrajectory(fileOf("truth_" + name + ".tum"), truth);
    for (const std::string& detector : options_.localisation.detectors) {
      evaluate::Trajectory estimate;
      for (std::size_t r = first_row; r < rows_.size(); ++r) {
        const LocalisationRow& row = rows_[r];
        if (row.detector == detector && row.result.status == evaluate::LocalisationStatus::kLocalised)
          estimate.push_back(poseOfLink(row.stamp_ns, row.result.estimate.map_from_optical));
      }
      writeTrajectory(fileOf("estimate_" + name + "_" + detector + ".tum"), estimate);
    }
  }

  std::string firstProblems() const {
    if (problems_.empty()) return "there is none";
    std::string text = std::to_string(problems_.size()) + " images could not be used (" +
                       fileOf("localisation_problems.csv") + "): ";
    for (std::size_t i = 0; i < std::min(problems_.size(), kProblemsShown); ++i) {
      const evaluate::LocalisationProblem& problem = problems_[i];
      text += (i == 0 ? "" : "; ") + problem.stream + " at " + textOfStamp(timeOf(problem.stamp_ns)) + ": " +
              problem.fault;
    }
    return text + (problems_.size() > kProblemsShown ? "; …" : "");
  }

  const BagLocalisationOptions& options_;
  LocalisationStreams streams_;
  evaluate::Localisation localisation_;
  std::string map_name_;
  std::vector<LocalisationRow> rows_;
  std::vector<evaluate::LocalisationProblem> problems_;
};

}  // namespace

std::vector<Field> fieldsOf(BagLocalisationOptions& options) {
  return {
      {"map",
       &options.maps,
       "",
       {},
       "localises instead: the map is made of this bag's images, depth and poses; of several streams say "
       "which, noon.bag:h12; may be repeated"},
      {"query",
       &options.queries,
       "",
       {},
       "bag whose images are looked for in the map, or some of its streams, day.bag:h04,h20; without them "
       "all but those of the map; may be repeated"}};
}

int localiseBags(const BagLocalisationOptions& options) {
  BagLocalisation localisation(options);
  const FolderLock lock(options.output_dir);
  return localisation.run();
}

}  // namespace sunlit::ros_interface
