#include "ros/evaluator/bag_localisation.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

#include "ros/evaluator/bag_streams.h"
#include "ros/evaluator/progress_log.h"
#include "ros/evaluator/result_files.h"
#include "ros/evaluator/view_source.h"
#include "sunlit/evaluate/comparisons/comparisons.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/localise/map.h"
#include "sunlit/evaluate/run/run_folder.h"

namespace sunlit::ros_interface {
namespace {

using evaluate::LocalisationRow;

class BagLocalisation {
 public:
  explicit BagLocalisation(const BagLocalisationOptions& options)
      : options_(options),
        streams_(localisationStreams(options.maps, options.queries, options.topics)),
        localisation_(options.localisation),
        source_({options.topics, options.intake, options.output_dir}),
        map_name_(nameOf(streams_.map)),
        origins_(options.localisation.detectors.size()) {}

  int run() {
    requireOnlyOwnResults(options_.output_dir, results());
    for (const BagStream& stream : streams_.map) addToMap(stream);
    tellMap();
    localisation_.finishMap();
    for (const BagStream& stream : streams_.queries) find(stream);
    if (rows_.empty()) source_.fail("no query can be used");
    const std::vector<evaluate::LocalisationSummary> summaries = summariesOf(rows_);
    writeLocalisation(fileOf(kLocalisationTable), rows_);
    writeLocalisationPoses(fileOf("localisation_poses.csv"), rows_);
    writeLocalisationSummary(fileOf("localisation_summary.csv"), summaries);
    const evaluate::Comparisons compared = comparisonsOf(measuredOf(rows_), {map_name_});
    writeComparisons(fileOf("comparisons.csv"), compared.rows);
    for (const auto* lines : {&compared.left_out, &compared.paired_by_place})
      for (const std::string& line : *lines) std::printf("%s\n", line.c_str());
    for (const Found& found : found_) writeTrajectories(found);
    std::printf("\n%s\n%s\n", localisationTable(summaries).c_str(), fileOf(kLocalisationTable).c_str());
    return source_.finish();
  }

 private:
  /// What came of one query stream.
  struct Found {
    BagStream stream;
    evaluate::Trajectory truth;
    std::size_t first_row = 0, end_row = 0;  // among rows_
  };

  static std::string nameOf(const std::vector<BagStream>& streams) {
    std::vector<std::string> names;
    for (const BagStream& stream : streams) names.push_back(stream.name);
    return evaluate::nameOfMap(names);
  }

  static evaluate::KeyFrameOrigin originOf(const BagStream& stream, const BagViews::Entry& entry) {
    return {stream.name, static_cast<std::int64_t>(entry.pose)};
  }

  /// Names of files.
  std::set<std::string> results() const {
    std::set<std::string> names = {kLocalisationTable};
    for (const BagStream& stream : streams_.queries) {
      names.insert(truthFile(stream));
      for (const std::string& detector : options_.localisation.detectors)
        names.insert(estimateFile(stream, detector));
    }
    return names;
  }

  std::string fileOf(const std::string& name) const { return options_.output_dir + "/" + name; }

  void addToMap(const BagStream& stream) {
    const auto views = source_.open(stream);
    evaluate::KeyFrameSpacing spacing(options_.localisation.map_every_m);
    std::vector<std::size_t> chosen;
    for (const std::size_t i : source_.usable(*views, true)) {
      if (spacing.takes(views->entries()[i].map_from_optical.translation())) chosen.push_back(i);
    }
    source_.forEach(*views, chosen, {"key frames made", true, [&](const auto& which, const auto& read) {
                                       const auto added = localisation_.addKeyFrames(read);
                                       for (std::size_t v = 0; v < which.size(); ++v)
                                         addOrigins(*views, which[v], v, added);
                                       return added.faults;
                                     }});
  }

  void addOrigins(const BagViews& views, std::size_t number, std::size_t view,
                  const evaluate::AddedKeyFrames& added) {
    const BagViews::Entry& entry = views.entries()[number];
    for (std::size_t d = 0; d < origins_.size(); ++d) {
      if (added.faults.count({view, d}) > 0) continue;
      origins_[d].push_back(originOf(views.stream(), entry));
      if (added.empty.count({view, d}) > 0)
        source_.addFeatureless(views.stream(), true, entry.stamp_ns, options_.localisation.detectors[d]);
    }
  }

  void tellMap() const {
    const std::vector<evaluate::MapSize> sizes = localisation_.mapSizes();
    const bool is_empty = std::all_of(sizes.begin(), sizes.end(),
                                      [](const evaluate::MapSize& size) { return size.key_frames == 0; });
    if (is_empty) source_.fail("the map has no key frame");
    for (const evaluate::MapSize& size : sizes) {
      std::printf("map %s, %s: %zu key frames with %zu points, %.1f MB (%.0f kB a key frame)\n",
                  map_name_.c_str(), size.detector.c_str(), size.key_frames, size.points,
                  static_cast<double>(size.bytes) / 1e6,
                  static_cast<double>(size.bytes) / 1e3 /
                      static_cast<double>(std::max<std::size_t>(size.key_frames, 1)));
    }
  }

  void find(const BagStream& stream) {
    const auto views = source_.open(stream);
    const std::vector<std::size_t> usable = source_.usable(*views, false);
    Found found{stream, {}, rows_.size()};
    source_.forEach(*views, usable, {"queries localised", false, [&](const auto& which, const auto& read) {
                                       auto localised = localisation_.localise(read);
                                       for (std::size_t q = 0; q < which.size(); ++q)
                                         addRows(*views, which[q], q, localised);
                                       return localised.faults;
                                     }});
    found.end_row = rows_.size();
    for (const std::size_t i : usable)
      found.truth.push_back(poseOfLink(views->entries()[i].stamp_ns, views->entries()[i].map_from_optical));
    found_.push_back(std::move(found));
  }

  void addRows(const BagViews& views, std::size_t number, std::size_t query,
               const evaluate::LocalisedQueries& localised) {
    const BagViews::Entry& entry = views.entries()[number];
    const std::vector<evaluate::LocalisedQuery>& results = localised.results[query];
    for (std::size_t d = 0; d < results.size(); ++d) {
      if (localised.faults.count({query, d}) > 0) continue;
      if (results[d].status == evaluate::LocalisationStatus::kNoFeatures)
        source_.addFeatureless(views.stream(), false, entry.stamp_ns, options_.localisation.detectors[d]);
      rows_.push_back({entry.pose, entry.stamp_ns, map_name_, views.stream().name,
                       options_.localisation.detectors[d], results[d], entry.map_from_optical,
                       evaluate::originOf(results[d], origins_[d]), views.drive()});
    }
  }

  void writeTrajectories(const Found& found) const {
    writeTrajectory(fileOf(truthFile(found.stream)), found.truth);
    for (const std::string& detector : options_.localisation.detectors) {
      evaluate::Trajectory estimate;
      for (std::size_t r = found.first_row; r < found.end_row; ++r) {
        const LocalisationRow& row = rows_[r];
        if (row.detector == detector && row.result.status == evaluate::LocalisationStatus::kLocalised)
          estimate.push_back(poseOfLink(row.stamp_ns, row.result.estimate.map_from_optical));
      }
      writeTrajectory(fileOf(estimateFile(found.stream, detector)), estimate);
    }
  }

  const BagLocalisationOptions& options_;
  LocalisationStreams streams_;
  evaluate::Localisation localisation_;
  ViewSource source_;
  std::string map_name_;
  std::vector<std::vector<evaluate::KeyFrameOrigin>> origins_;  // by detector, of its key frames
  std::vector<LocalisationRow> rows_;
  std::vector<Found> found_;
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
       "all but those of the map; may be repeated"},
      {"odometry",
       &options.odometry,
       "",
       {},
       "follows the camera of this bag, or of some of its streams, by its own images and depth alone; may be "
       "repeated"}};
}

int localiseBags(const BagLocalisationOptions& options) {
  BagLocalisation localisation(options);
  evaluate::requireNoRun(options.output_dir);
  return localisation.run();
}

}  // namespace sunlit::ros_interface
