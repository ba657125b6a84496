/// Where the parts of an atlas stand in its folder, and which are done.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sunlit/evaluate/atlas/atlas.h"
#include "tools/atlas_options.h"

namespace sunlit::tools {

/// A range of poses under a range of lights, of one file.
struct ObserveUnit {
  std::size_t first_pose, end_pose;  ///< of AtlasRunOptions::poses
  std::size_t first_condition, end_condition;
  std::string file;  ///< of observations, whole
  /// What `file` is called until it is whole.
  std::string growing() const { return file + ".growing"; }
};

/// All queries of one map and method: a cell each.
struct CompareUnit {
  std::string map;  ///< a condition
  std::string method;
};

class AtlasFolder {
 public:
  explicit AtlasFolder(const AtlasRunOptions& options);

  /// Independent of one another, in an order that depends on the options alone.
  const std::vector<ObserveUnit>& observeUnits() const { return observe_units_; }
  const std::vector<CompareUnit>& compareUnits() const { return compare_units_; }

  std::string cell(const evaluate::AtlasCellKey& key) const;
  std::string lights() const { return folder_ + "/lights.csv"; }
  std::string file(const std::string& name) const { return folder_ + '/' + name; }
  std::string cellsOf(const CompareUnit& unit) const;
  std::string observations() const { return folder_ + "/observations"; }

  bool isObserved(const ObserveUnit& unit) const;
  /// The queries that `unit` lacks, in the order of the lights.
  std::vector<std::string> missingQueries(const CompareUnit& unit) const;
  /// Of all cells and of all units of observing.
  std::size_t cellsMissing() const;
  std::size_t unitsMissing() const;
  /// Of what there is.
  double bytes() const;

 private:
  std::string folder_;
  std::vector<std::string> conditions_;
  std::vector<ObserveUnit> observe_units_;
  std::vector<CompareUnit> compare_units_;
};

/// Held by whoever works at a unit, so that no two do.
class UnitLock {
 public:
  /// Throws std::runtime_error where another process holds it.
  explicit UnitLock(const std::string& file);
  ~UnitLock();
  UnitLock(const UnitLock&) = delete;
  UnitLock& operator=(const UnitLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace sunlit::tools
