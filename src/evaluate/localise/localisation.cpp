#include "sunlit/evaluate/localise/localisation.h"

#include <stdexcept>
#include <utility>

#include "evaluate/features/detector_pool.h"
#include "evaluate/localise/each_detector.h"

namespace sunlit::evaluate {

struct Localisation::PerDetector {
  PerDetector(const Detector& detector, const LocalisationOptions& options)
      : pool(detector, options.cache), localiser(detector.space(), options.localiser) {}
  mutable DetectorPool pool;
  Localiser localiser;
};

Field mapEveryRow(double* map_every_m) {
  return {"map_every",
          map_every_m,
          "m",
          {0, 1e6},
          "of path from one key frame of the map to the next; 0: every pose"};
}

std::vector<Field> fieldsOf(LocalisationOptions& options) {
  std::vector<std::string>* const names = &options.detectors;
  const Choices choices{options.known.namesOfDetectors(), [names] { return *names; },
                        [names](const std::vector<std::string>& some) { *names = some; }};
  return joined({{{"detectors", choices, "", {}, "names apart by commas"}, mapEveryRow(&options.map_every_m)},
                 fieldsOf(options.localiser)});
}

const Detector& detectorOf(const LocalisationOptions& options, const std::string& name) {
  const Detector* const detector = options.known.at(name).detector();
  if (detector == nullptr) throw std::invalid_argument(name + " finds no features to localise by");
  return *detector;
}

Localisation::Localisation(const LocalisationOptions& options) : options_(options) {
  requireFields(options_);
  for (const std::string& name : options_.detectors) {
    detectors_.push_back(std::make_unique<PerDetector>(detectorOf(options_, name), options_));
  }
}

Localisation::~Localisation() = default;

AddedKeyFrames Localisation::addKeyFrames(const std::vector<PosedView>& views) {
  for (const PosedView& view : views) {
    requireWhole(view);
    if (view.depth.empty()) throw std::invalid_argument("a view has no depth, but a map needs it");
  }
  std::vector<KeyFrame> frames(views.size() * detectors_.size());
  AddedKeyFrames added;
  added.faults = forEachDetector(views, options_.detectors, [&](std::size_t v, std::size_t d) {
    frames[v * detectors_.size() + d] = keyFrameOf(views[v], detectors_[d]->pool.detect(views[v].picture));
  });
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (std::size_t d = 0; d < detectors_.size(); ++d) {
      if (added.faults.count({v, d}) > 0) continue;
      KeyFrame& frame = frames[v * detectors_.size() + d];
      if (frame.points.empty()) added.empty.emplace(v, d);
      detectors_[d]->localiser.add(std::move(frame));
    }
  }
  return added;
}

void Localisation::finishMap() {
  for (const auto& detector : detectors_) detector->localiser.finish();
}

std::vector<MapSize> Localisation::mapSizes() const {
  std::vector<MapSize> sizes;
  for (std::size_t d = 0; d < detectors_.size(); ++d) {
    MapSize size;
    size.detector = options_.detectors[d];
    for (const KeyFrame& frame : detectors_[d]->localiser.frames()) {
      ++size.key_frames;
      size.points += frame.points.size();
      size.bytes += bytesOf(frame);
    }
    sizes.push_back(size);
  }
  return sizes;
}

LocalisedQueries Localisation::localise(const std::vector<PosedView>& queries) const {
  for (const PosedView& query : queries) requireWhole(query);
  LocalisedQueries localised;
  localised.results.assign(queries.size(), std::vector<LocalisedQuery>(detectors_.size()));
  localised.faults = forEachDetector(queries, options_.detectors, [&](std::size_t q, std::size_t d) {
    const PosedView& query = queries[q];
    const Features found = straightOnes(detectors_[d]->pool.detect(query.picture), query.camera).straight;
    localised.results[q][d] =
        detectors_[d]->localiser.localise({found, query.camera, query.map_from_optical});
  });
  return localised;
}

}  // namespace sunlit::evaluate
