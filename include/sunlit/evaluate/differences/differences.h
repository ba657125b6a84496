/// The differences that can be asked for, by name.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/difference.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// Each with its options: `boolean_rgb boolean_grey euclidean_rgb euclidean_grey`, and one for each of
/// detectorTypes(), in that order; and more that are added. Names are those of parameters and result files.
class Differences {
 public:
  Differences();
  Differences(const Differences& other);
  Differences& operator=(const Differences& other);
  Differences(Differences&&) = default;
  Differences& operator=(Differences&&) = default;
  ~Differences() = default;

  std::vector<std::string> names() const;
  /// Of those that match features.
  std::vector<std::string> namesOfDetectors() const;
  /// Throws std::invalid_argument for a name that is none of them.
  const Difference& at(const std::string& name) const;
  /// One more. Throws std::invalid_argument where `name` is taken, or is not made of letters, digits and _,
  /// first a letter.
  void add(const std::string& name, std::unique_ptr<Difference> difference);
  /// Options of those of `names`: `features/NAME/…` of those that match features, `pixels/NAME/…` of the
  /// others.
  std::vector<Field> fieldsOf(const std::vector<std::string>& names);

 private:
  std::vector<std::pair<std::string, std::unique_ptr<Difference>>> all_;
};

/// Those of the paper, which are compared where nothing else is asked for: `boolean_rgb boolean_grey
/// euclidean_rgb euclidean_grey sift surf orb brisk`; surf only where it was built in.
std::vector<std::string> paperDifferences();

/// Some of `known` by their names.
Choices someOf(const Differences& known, std::vector<std::string>* names);

}  // namespace sunlit::evaluate
