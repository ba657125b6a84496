/// The parameters of the evaluator, from a parameter server or a file.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

#include "ros/evaluator/image_intake.h"
#include "sunlit/evaluate/run/evaluation.h"
#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

struct EvaluatorOptions {
  evaluate::EvaluationOptions evaluation;
  double memory_limit_gb = 1.0;  ///< evaluation.memory_limit_bytes, as people type it
  double features_cache_gb = evaluate::kUsualFeaturesCache_gb;  ///< 0: no features are kept
  IntakeOptions intake;
  double idle_timeout_s =
      0.0;  ///< without any image, after which the node ends with what is missing named; 0: never
  double diagnostic_period_s = 1.0;  ///< read by diagnostic_updater itself
  bool report = true;                ///< draw report.html when all is evaluated
  bool exit_when_done = false;       ///< end the process when all expected poses are accounted for
};

/// One row for each parameter, but for those of detectors under names of one's own.
std::vector<Field> fieldsOf(EvaluatorOptions& options);
/// `features/NAME/…`: what such a detector is told beside the parameters of its type.
std::vector<Field> fieldsOfOwnDetector(evaluate::Preprocessings& preprocessings);

/// Reads every key and rejects unknown ones. Throws std::invalid_argument naming key, value and what is
/// allowed.
EvaluatorOptions readEvaluatorOptions(const ParameterReader& parameters);

/// A YAML file of parameters, for programs without a master: what rosparam would read in it, but for tags,
/// and for numbers such as 1_000, 12:30 and 0b11, which stay texts. Throws std::runtime_error with path and
/// line.
XmlRpc::XmlRpcValue readParameterFile(const std::string& path);

/// The same as parameters.
inline ParameterReader parametersOfFile(const std::string& path) {
  return {readParameterFile(path), path};
}

}  // namespace sunlit::ros_interface
