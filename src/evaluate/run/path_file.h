/// path.csv: where the camera stood when the images of each pose were taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "evaluate/files/files.h"
#include "evaluate/run/pose_index.h"
#include "evaluate/run/recent.h"
#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::evaluate {

/// Places that are not in the file.
struct LeftOutPlaces {
  std::size_t without_image = 0;
  std::size_t unplaced = 0;  ///< of a stamp of which no capture says which pose it is
  std::size_t of_two = 0;    ///< of a stamp of which poses of two places came
};

/// A place counts where an image has its stamp; with a frame rate, of those that round to the pose of an
/// image the nearest to the stamp that the rate gives it. It may come before the image, or after. The file
/// grows while images come in and is sorted, without doubles, at the end.
class PathFile {
 public:
  /// Reads what an earlier run left in `folder`, and goes on from there. `poses` outlives this.
  PathFile(const std::string& folder, const PoseIndex& poses);
  /// Adds what a run in another folder left.
  void merge(const std::string& other_folder) { read(other_folder); }
  void add(const PlaceRecord& place);
  /// An image of this stamp was taken.
  void noteImage(std::int64_t stamp_ns);
  /// Leaves out those of stamps of two places: nobody can tell which is that of the images.
  LeftOutPlaces finish(const std::function<bool(std::int64_t)>& is_of_two_places);

 private:
  void read(const std::string& folder);
  void append(const PlaceRecord& place);
  void close();
  void remove();
  void write(const std::string& lines);
  std::optional<std::int64_t> keyOf(std::int64_t stamp_ns) const;

  std::string path_;
  const PoseIndex& poses_;
  AppendFile file_;
  bool is_open_ = false;
  std::map<std::int64_t, PlaceRecord> taken_up_;              // by stamp, of earlier runs
  std::map<std::int64_t, std::optional<PlaceRecord>> found_;  // of images, by keyOf(); empty: none has come
  Recent<PlaceRecord> waiting_;                               // for an image, by keyOf()
  std::size_t left_out_ = 0;                                  // of no image, but those that wait
};

}  // namespace sunlit::evaluate
