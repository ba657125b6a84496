/// Two drives along one path, compared by any method of finding places.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/feature_cache.h"
#include "sunlit/evaluate/places/picture_folder.h"
#include "sunlit/evaluate/places/place_scores.h"

namespace sunlit::evaluate {

/// A way to find places.
struct PlaceMethod {
  enum class Kind {
    kSad,      ///< the nearest thumbnail, see thumbnails.h
    kSeqSlam,  ///< the best sequence of thumbnails, see sequences.h
    kVlad      ///< the nearest vector of all features, see vlad.h
  };
  Kind kind = Kind::kSad;
  std::string detector;  ///< of kVlad: one of detectorNames(readyDetectorTypes()), with its usual parameters
  std::string name() const;
};

/// "sad", "seqslam", and "vlad:" before each of readyDetectorTypes().
std::vector<PlaceMethod> allPlaceMethods();
/// By its name: one of those, or "vlad:" before another of detectorNames() of these. Throws
/// std::invalid_argument naming it and all that there are; in the message it is `called` so.
PlaceMethod placeMethod(const std::string& name, const std::string& called = "method");

/// What one method found.
struct FoundPlaces {
  PlaceMatrix distances;            ///< that places are ranked by
  std::vector<PlaceGuess> guesses;  ///< for each query; by uniqueness for seqslam, else by distance
  std::vector<std::string> notes;   ///< what a person should know of these pictures: counts of empty ones
};

class PlaceComparison {
 public:
  /// `what` is done for `done` of `all` pictures. Called by one thread at a time.
  using Progress = std::function<void(const std::string& what, std::size_t done, std::size_t all)>;

  /// Features that are in `cache` are not found again; null: none are kept.
  PlaceComparison(const PictureFolder& map, const PictureFolder& queries, Progress progress,
                  std::shared_ptr<FeatureCache> cache = nullptr);

  /// Throws std::invalid_argument where `method` cannot work with so few pictures, before any is read.
  void require(const PlaceMethod& method) const;
  /// Pictures may differ in size. Runs in parallel, to the same bits. Throws std::runtime_error naming a
  /// picture that cannot be read; std::invalid_argument where a map has too few different descriptors.
  FoundPlaces find(const PlaceMethod& method);

 private:
  struct ThumbnailComparison {
    PlaceMatrix differences;
    std::vector<std::string> notes;
  };
  const ThumbnailComparison& thumbnails();
  FoundPlaces findByVlad(const std::string& detector) const;
  /// work(i) for each picture of a folder, in parallel.
  void forEach(const std::string& what, const PictureFolder& pictures,
               const std::function<void(std::size_t)>& work) const;

  PictureFolder map_;
  PictureFolder queries_;
  Progress progress_;
  std::shared_ptr<FeatureCache> cache_;
  std::optional<ThumbnailComparison> thumbnails_;  ///< two methods go by them
};

}  // namespace sunlit::evaluate
