/// Localisation of recorded images against a map made of others.
#pragma once

#include <string>
#include <vector>

#include "ros/evaluator/image_intake.h"
#include "ros/evaluator/view_topics.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/quantity/field.h"

namespace sunlit::ros_interface {

struct BagLocalisationOptions {
  std::vector<std::string> maps;  ///< as localisationStreams() takes them
  std::vector<std::string> queries;
  std::vector<std::string> odometry;  ///< for odometryOfBags(), instead of both
  std::string output_dir;
  ViewTopics topics;
  IntakeOptions intake;
  evaluate::LocalisationOptions localisation;
};

/// Rows of --map, --query and --odometry; what the localisation is told has rows of its own.
std::vector<Field> fieldsOf(BagLocalisationOptions& options);

/// Makes the map, finds the queries, writes localisation.csv, localisation_summary.csv, what could not be
/// used (localisation_problems.csv), and for each query stream its truth and each detector's estimate as TUM
/// files (truth_NAME.tum, estimate_NAME_DETECTOR.tum; of camera_link), and prints a table. The exit status of
/// the program: 0, or 3 where an image could not be used, or not by each detector. Throws std::runtime_error
/// for a bag that cannot be read, and where no key frame or no query is left.
int localiseBags(const BagLocalisationOptions& options);

}  // namespace sunlit::ros_interface
