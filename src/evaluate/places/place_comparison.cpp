#include "sunlit/evaluate/places/place_comparison.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "evaluate/features/detector_pool.h"
#include "sunlit/evaluate/places/sequences.h"
#include "sunlit/evaluate/places/thumbnails.h"
#include "sunlit/evaluate/places/vlad.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kVladPrefix = "vlad:";

std::size_t countBlank(const std::vector<cv::Mat>& vlads) {
  return static_cast<std::size_t>(std::count_if(
      vlads.begin(), vlads.end(), [](const cv::Mat& vlad) { return cv::countNonZero(vlad) == 0; }));
}

std::string countOf(std::size_t part, std::size_t all, const std::string& what) {
  return std::to_string(part) + " of " + std::to_string(all) + " " + what;
}

std::string constantPatches(const std::vector<Thumbnail>& thumbnails, const std::string& what) {
  std::size_t constant = 0;
  for (const Thumbnail& thumbnail : thumbnails)
    constant += static_cast<std::size_t>(thumbnail.constant_patches);
  constexpr std::size_t kPatches = kThumbnailWidth * kThumbnailHeight / (kPatchSide * kPatchSide);
  return countOf(constant, kPatches * thumbnails.size(), "patches of the " + what);
}

std::size_t countConstant(const std::vector<Thumbnail>& thumbnails) {
  return static_cast<std::size_t>(std::count_if(thumbnails.begin(), thumbnails.end(),
                                                [](const Thumbnail& t) { return t.constant_patches > 0; }));
}

}  // namespace

std::string PlaceMethod::name() const {
  switch (kind) {
    case Kind::kSad:
      return "sad";
    case Kind::kSeqSlam:
      return "seqslam";
    case Kind::kVlad:
      return kVladPrefix + detector;
  }
  return "";
}

std::vector<PlaceMethod> allPlaceMethods() {
  std::vector<PlaceMethod> methods(2);
  methods[1].kind = PlaceMethod::Kind::kSeqSlam;
  for (const std::string& detector : readyDetectorTypes())
    methods.push_back({PlaceMethod::Kind::kVlad, detector});
  return methods;
}

PlaceMethod placeMethod(const std::string& name, const std::string& called) {
  std::string names;
  for (const PlaceMethod& method : allPlaceMethods()) {
    if (method.name() == name) return method;
    names += (names.empty() ? "" : ", ") + method.name();
  }
  const std::vector<std::string> detectors = detectorNames(readyDetectorTypes());
  for (const std::string& detector : detectors) {
    if (name == kVladPrefix + detector) return {PlaceMethod::Kind::kVlad, detector};
  }
  refuse(called, '"' + name + '"',
         "one of " + names + ", or vlad of a detector behind a preprocessing, as " + kVladPrefix +
             detectors.back());
}

PlaceComparison::PlaceComparison(const PictureFolder& map, const PictureFolder& queries, Progress progress,
                                 std::shared_ptr<FeatureCache> cache)
    : map_(map), queries_(queries), progress_(std::move(progress)), cache_(std::move(cache)) {}

void PlaceComparison::require(const PlaceMethod& method) const {
  if (method.kind != PlaceMethod::Kind::kSeqSlam) return;
  const auto check = [](const PictureFolder& pictures, int fewest) {
    if (pictures.names.size() >= static_cast<std::size_t>(fewest)) return;
    throw std::invalid_argument(pictures.folder + ": holds " + std::to_string(pictures.names.size()) +
                                " pictures, but a sequence of seqslam needs at least " +
                                std::to_string(fewest));
  };
  check(queries_, kFewestQueries);
  check(map_, kFewestPlaces);
}

void PlaceComparison::forEach(const std::string& what, const PictureFolder& pictures,
                              const std::function<void(std::size_t)>& work) const {
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, pictures.names.size(), [&](std::size_t i) {
    work(i);
    const std::lock_guard<std::mutex> lock(mutex);
    if (progress_) progress_(what, ++done, pictures.names.size());
  });
}

const PlaceComparison::ThumbnailComparison& PlaceComparison::thumbnails() {
  if (thumbnails_) return *thumbnails_;
  std::vector<Thumbnail> map(map_.names.size()), queries(queries_.names.size());
  forEach("thumbnails of the map", map_,
          [&](std::size_t i) { map[i] = makeThumbnail(readPicture(map_.file(i)).grey); });
  forEach("thumbnails of the queries", queries_,
          [&](std::size_t i) { queries[i] = makeThumbnail(readPicture(queries_.file(i)).grey); });
  thumbnails_.emplace();
  if (countConstant(map) + countConstant(queries) > 0) {
    thumbnails_->notes.push_back(constantPatches(map, "map") + " and " + constantPatches(queries, "queries") +
                                 " are constant and count as 0");
  }
  thumbnails_->differences = thumbnailDifferences(queries, map);
  return *thumbnails_;
}

FoundPlaces PlaceComparison::findByVlad(const std::string& detector) const {
  const std::unique_ptr<Detector> usual = makeDetector(DetectorKind::named(detector));
  const DescriptorSpace space = usual->space();
  DetectorPool detectors(*usual, cache_);
  const auto describe = [&](const std::string& file) {
    return detectors.detect(readPicture(file)).descriptors;
  };
  std::vector<cv::Mat> map(map_.names.size()), queries(queries_.names.size());
  forEach(detector + " of the map", map_, [&](std::size_t i) { map[i] = describe(map_.file(i)); });
  const cv::Mat words =
      trainVocabulary(vladPoints(space, vladTrainingDescriptors(map)), kVisualWords, kVocabularySeed);
  const auto encode = [&](const cv::Mat& descriptors) {
    return vladOf(vladPoints(space, descriptors), words);
  };
  forEach("words of the map", map_, [&](std::size_t i) { map[i] = encode(map[i]); });
  forEach(detector + " of the queries", queries_,
          [&](std::size_t i) { queries[i] = encode(describe(queries_.file(i))); });
  FoundPlaces found;
  found.distances = vladDistances(queries, map);
  found.guesses = nearestPlaces(found.distances);
  const std::size_t blank_map = countBlank(map), blank_queries = countBlank(queries);
  if (blank_map + blank_queries > 0) {
    found.notes.push_back(countOf(blank_map, map.size(), "pictures of the map and ") +
                          countOf(blank_queries, queries.size(), "queries have no features: ") +
                          "such a place is never found, such a query finds nothing");
  }
  return found;
}

FoundPlaces PlaceComparison::find(const PlaceMethod& method) {
  require(method);
  if (method.kind == PlaceMethod::Kind::kVlad) return findByVlad(method.detector);
  const ThumbnailComparison& compared = thumbnails();
  FoundPlaces found;
  found.notes = compared.notes;
  if (method.kind == PlaceMethod::Kind::kSad) {
    found.distances = compared.differences;
    found.guesses = nearestPlaces(found.distances);
  } else {
    found.distances = sequenceScores(enhanceContrast(compared.differences));
    found.guesses = uniquePlaces(found.distances);
  }
  return found;
}

}  // namespace sunlit::evaluate
