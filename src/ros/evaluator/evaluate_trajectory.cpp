/// evaluate_trajectory: an estimated trajectory against the true one, of files or bags, without a master.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ros/evaluator/bag_trajectory.h"
#include "ros/evaluator/folder_lock.h"
#include "ros/evaluator/view_topics.h"
#include "sunlit/evaluate/trajectory/draw_trajectory.h"
#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/studio/command_line.h"

namespace {

using namespace sunlit;
using namespace sunlit::evaluate;
using namespace sunlit::ros_interface;

/// A trajectory as people name it.
struct Named {
  std::string file;
  PosesOf of = PosesOf::kLink;
};

struct Options {
  Named truth, estimate;
  std::string output;
  std::string map;  ///< folder; empty: none
  bool takes_first_of_stamp = true;
  TrajectoryOptions evaluation;
};

std::vector<Delta> deltasOf(const std::string& value) {
  std::vector<Delta> deltas;
  std::istringstream parts(value);
  for (std::string part; std::getline(parts, part, ',');) {
    const Delta delta = parseDelta(part);
    const auto is_same = [&](const Delta& other) { return other.name() == delta.name(); };
    if (std::any_of(deltas.begin(), deltas.end(), is_same)) refuse("delta", value, "each once");
    deltas.push_back(delta);
  }
  return deltas;
}

std::string namesOf(const std::vector<Delta>& deltas) {
  std::string text;
  for (const Delta& delta : deltas) text += (text.empty() ? "" : ",") + delta.name();
  return text;
}

std::optional<Options> parse(const std::vector<std::string>& arguments) {
  Options options;
  const std::vector<Field> rows = fieldsOf(options.evaluation);
  studio::CommandLine line(
      "evaluate_trajectory: absolute and relative errors of an estimated trajectory. Needs no ROS master.",
      "evaluate_trajectory --out DIR --truth FILE --estimate FILE [options]");
  const std::string forms =
      "TUM (timestamp tx ty tz qx qy qz qw, s and m; ns where the first stamp is beyond 9.2e9), ground truth "
      "of EuRoC, or run.bag:TOPIC of Odometry, "
      "PoseStamped, PoseWithCovarianceStamped, TransformStamped or Path (the last counts)";
  line.add("--truth FILE", {"truth", &options.truth.file, "", {}, forms});
  line.add("--estimate FILE", {"estimate", &options.estimate.file, "", {}, "as the truth; of the same body"});
  line.add("--truth-of", bodyRow("truth_of", &options.truth.of));
  line.add("--estimate-of", bodyRow("estimate_of", &options.estimate.of));
  line.add(
      "--out DIR",
      {"out", &options.output, "", {}, "folder for trajectory.csv, trajectory_poses.csv and trajectory.png"});
  line.add(
      "--map DIR",
      {"map", &options.map, "", {}, "output folder of an experiment whose map.png lies under the picture"});
  line.add("--repeated-stamps",
           {"repeated_stamps",
            choiceOf(&options.takes_first_of_stamp, {"refuse", "first"}),
            "",
            {},
            "of poses of one stamp in a file: an error; the first counts, and how many do not is said"});
  line.add("--align", fieldOf(rows, "align"));
  line.add("--max-difference S", fieldOf(rows, "max_difference"));
  line.add("--pairs-from", fieldOf(rows, "pairs_from"));
  line.add("--delta LIST", {"delta",
                            OwnForm{namesOf(options.evaluation.deltas)},
                            "",
                            {},
                            "of relative errors, between poses: metres of path (10m), or frames (1frame)"})
      .then(
          [&](const std::string&, const std::string& value) { options.evaluation.deltas = deltasOf(value); });
  if (!line.read(arguments)) return std::nullopt;
  for (const std::string needed : {"--out", "--truth", "--estimate"}) {
    if (!line.has(needed)) throw std::invalid_argument(needed + " is missing; --help lists all options");
  }
  return options;
}

/// Of camera_link what is of its optical frame.
Trajectory ofLink(Trajectory poses) {
  const Eigen::Quaterniond optical_from_link(linkFromOptical().linear().transpose());
  for (StampedPose& pose : poses) pose.orientation = (pose.orientation * optical_from_link).normalized();
  return poses;
}

/// A trajectory, of the link, and what it is called.
struct Input {
  Input(std::string the_name, const Named& named, bool takes_first_of_stamp)
      : name(std::move(the_name)),
        file(named.file),
        poses(isOfBag(file) ? readBagTrajectory(file, &left_out)
                            : readTrajectory(file, takes_first_of_stamp ? &left_out.repeated : nullptr)) {
    if (named.of == PosesOf::kOptical) poses = ofLink(std::move(poses));
    if (!takes_first_of_stamp && !left_out.repeated.empty()) {
      throw std::runtime_error(
          file + ": " + std::to_string(left_out.repeated.size()) +
          " poses have the stamp of the one before; --repeated-stamps first leaves them out");
    }
  }

  /// In words; empty where that is nothing.
  std::string leftOut() const {
    std::string text;
    if (!left_out.repeated.empty())
      text += "; " + std::to_string(left_out.repeated.size()) + " more left out, whose stamps repeat";
    if (left_out.unusable > 0)
      text += "; " + std::to_string(left_out.unusable) +
              " more left out, which cannot be used, the first is " + left_out.first_unusable;
    return text;
  }

  void tell(std::size_t without_partner) const {
    std::printf("%-8s  %s: %zu poses, %.3f m", name.c_str(), file.c_str(), poses.size(), lengthOf(poses));
    if (without_partner > 0) std::printf("; %zu without a partner", without_partner);
    std::printf("%s\n", leftOut().c_str());
  }

  std::string name, file;
  LeftOutPoses left_out;
  Trajectory poses;
};

void tellAlignment(const Similarity& s) {
  const Eigen::AngleAxisd turn(s.rotation);
  std::printf(
      "aligned   scale %.9g, turned by %.6g deg about (%.4f, %.4f, %.4f), moved by (%.6g, %.6g, %.6g) m\n",
      s.scale, turn.angle() / kRadPerDeg, turn.axis().x(), turn.axis().y(), turn.axis().z(),
      s.translation.x(), s.translation.y(), s.translation.z());
}

void tellRows(const std::vector<TrajectoryRow>& rows) {
  std::printf("\n%-14s %-4s %7s %11s %11s %11s %11s %11s %11s\n", "metric", "unit", "n", "rmse", "mean",
              "median", "std", "min", "max");
  for (const TrajectoryRow& row : rows) {
    const ErrorStatistics& s = row.statistics;
    std::printf("%-14s %-4s %7zu %11.6g %11.6g %11.6g %11.6g %11.6g %11.6g\n", row.metric.c_str(),
                row.unit.c_str(), s.n, s.rmse, s.mean, s.median, s.std, s.min, s.max);
  }
}

/// Where that fails, poses that were left out may be why.
TrajectoryEvaluation evaluationOf(const Input& truth, const Input& estimate,
                                  const TrajectoryOptions& options) {
  try {
    return evaluateTrajectory(truth.poses, estimate.poses, options);
  } catch (const std::invalid_argument& error) {
    std::string text = error.what();
    for (const Input* input : {&truth, &estimate}) {
      const std::string words = input->leftOut();
      if (words.empty()) continue;
      const std::size_t count = input->poses.size();
      text +=
          "; " + input->file + " has " + std::to_string(count) + (count == 1 ? " pose" : " poses") + words;
    }
    throw std::invalid_argument(text);
  }
}

void run(const Options& options) {
  const Input truth("truth", options.truth, options.takes_first_of_stamp);
  const Input estimate("estimate", options.estimate, options.takes_first_of_stamp);
  for (const Input* input : {&truth, &estimate})
    for (const std::string& warning : input->left_out.of_frames)
      std::fprintf(stderr, "warning: %s\n", warning.c_str());
  std::optional<MapPicture> map;
  if (!options.map.empty()) map = readMapPicture(options.map);
  const TrajectoryEvaluation evaluation = evaluationOf(truth, estimate, options.evaluation);
  const FolderLock lock(options.output);
  writeTrajectoryTable(options.output + "/trajectory.csv", evaluation);
  writePoseErrors(options.output + "/trajectory_poses.csv", truth.poses, estimate.poses, evaluation);
  image::writePng(options.output + "/trajectory.png",
                  drawTrajectory(truth.poses, evaluation, map ? &*map : nullptr));
  truth.tell(evaluation.association.truth_left.size());
  estimate.tell(evaluation.association.estimate_left.size());
  std::printf("matched   %zu pairs within %g s\n", evaluation.association.pairs.size(),
              options.evaluation.max_difference_s);
  if (options.evaluation.align != Alignment::kNone) tellAlignment(evaluation.truth_from_estimate);
  tellRows(evaluation.rows);
  std::printf("%s/trajectory.csv\n", options.output.c_str());
  if (const std::string doubt = doubtOfAlignment(evaluation); !doubt.empty())
    std::fprintf(stderr, "warning: %s\n", doubt.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  return studio::runProgram({"evaluate_trajectory", argc, argv}, parse, run);
}
