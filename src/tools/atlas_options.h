/// The command line of `atlas`.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/atlas/atlas.h"
#include "sunlit/quantity/field.h"
#include "sunlit/studio/studio.h"
#include "tools/place_arguments.h"
#include "tools/time_of_day.h"

namespace sunlit::tools {

/// One light: a time of a day.
struct AtlasCondition {
  astronomy::CivilDate date;
  TimeOfDay time;
  std::string name;  ///< "h04_30"; of several days "2024-06-21_h04_30"
};

/// One pose of the path.
struct AtlasPose {
  std::int64_t number;  ///< of the whole path
  Eigen::Isometry3d map_from_camera;
  Eigen::Isometry3d map_from_query_camera;  ///< the same without a query drive
};

/// What work is done in two stages that each fall into units.
enum class AtlasStage { kObserve, kCompare };

/// Every N-th unit of a stage.
struct AtlasShard {
  std::size_t number = 1;  ///< 1 … of
  std::size_t of = 1;

  bool has(std::size_t unit) const { return unit % of == number - 1; }
};

struct SlurmOptions {
  int tasks = 32;
  std::vector<std::string> options;  ///< of sbatch, each a line of every script
  bool submits = true;
};

struct AtlasRunOptions {
  studio::StudioOptions studio;
  PlaceOptions place;
  evaluate::AtlasOptions atlas;
  std::vector<AtlasCondition> conditions;  ///< one or more, by date and time as they were asked for
  std::vector<AtlasPose> poses;            ///< one or more
  std::string output;                      ///< folder
  int unit_poses = 0;                      ///< 0: by the path
  int unit_conditions = 0;                 ///< 0: all
  std::optional<AtlasStage> stage;         ///< empty: both, and then the merge
  AtlasShard shard;
  bool merge = false;  ///< nothing else
  bool estimate = false;
  bool draws = true;
  std::optional<SlurmOptions> slurm;
  std::vector<std::string> recipe;  ///< what decides what is written
  std::vector<std::string> again;   ///< arguments that make the same atlas, but for the part of the work
};

/// Empty if help was asked for, and has been printed. Throws std::invalid_argument naming the option, its
/// value and what is allowed, and what posesOf() throws.
std::optional<AtlasRunOptions> parseAtlasOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
