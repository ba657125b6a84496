/// The evaluation of recorded bags, without a master.
#pragma once

#include <string>
#include <vector>

#include "ros/evaluator/evaluator_options.h"

namespace sunlit::ros_interface {

struct BagEvaluationOptions {
  evaluate::EvaluationOptions evaluation;
  std::vector<std::string>
      bags;  ///< read together, in the order of their times; none where only runs are merged
  std::string name_space = "/";  ///< of the topics: <name_space>/<stream>/camera/image_raw
  bool report = true;            ///< draw report.html
  IntakeOptions intake;          ///< `compressed` prefers compressed images where a stream has both
};

/// What is typed; the evaluation's parameters come from a file.
std::vector<Field> fieldsOf(BagEvaluationOptions& options);

/// Reads all bags, writes the result files, with a report, and a table to standard output. The exit status of
/// the program: 0 where every pair was evaluated or is undefined, 3 where one could not be. Throws
/// std::runtime_error for a bag that cannot be read, and for a stream of which the bags hold no image.
int evaluateBags(const BagEvaluationOptions& options);

}  // namespace sunlit::ros_interface
