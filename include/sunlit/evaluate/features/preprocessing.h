/// What a picture is made into before a detector looks at it, so that light counts for less.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/picture.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// One way to do so, with its options.
///
/// To add one: a file like src/evaluate/features/preprocessing/gamma.cpp, and its row in the table of
/// preprocessing.cpp.
class Preprocessing {
 public:
  virtual ~Preprocessing() = default;
  virtual std::unique_ptr<Preprocessing> clone() const = 0;
  /// Its options, rows that point into it.
  virtual std::vector<Field> fields() = 0;
  /// CV_8UC1, of the size of the picture, and made of it alone: pictures of one scene stay comparable, as by
  /// one rule for all of them. The same to the bit for any number of threads; may be called from several.
  virtual cv::Mat of(const Picture& picture) const = 0;
};

/// `clahe gamma illumination_invariant`.
const std::vector<std::string>& preprocessingNames();
/// With its usual options. Throws std::invalid_argument for what is not one of preprocessingNames().
std::unique_ptr<Preprocessing> makePreprocessing(const std::string& name);

/// All of them, each with its options.
class Preprocessings {
 public:
  Preprocessings();
  Preprocessings(const Preprocessings& other);
  Preprocessings& operator=(const Preprocessings& other);
  Preprocessings(Preprocessings&&) = default;
  Preprocessings& operator=(Preprocessings&&) = default;
  ~Preprocessings() = default;
  /// Throws as makePreprocessing().
  const Preprocessing& at(const std::string& name) const;
  /// `NAME/…`.
  std::vector<Field> fields();

 private:
  std::vector<std::unique_ptr<Preprocessing>> all_;  // by the order of preprocessingNames()
};

}  // namespace sunlit::evaluate
