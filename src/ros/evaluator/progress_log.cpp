#include "ros/evaluator/progress_log.h"

#include <ros/console.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "sunlit/evaluate/files/report.h"
#include "sunlit/quantity/comma_list.h"
#include "sunlit/quantity/duration.h"

namespace sunlit::ros_interface {
namespace {

constexpr double kSecondsBetweenLines = 10.0;

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

struct Cell {
  std::string column;
  std::string row;
  std::string text;
};

/// Columns and rows as they first occur.
std::string tableOf(const std::string& title, const std::vector<Cell>& cells) {
  constexpr std::size_t kColumnWidth = 24;
  std::vector<std::string> columns;
  std::vector<std::string> names;
  std::map<std::string, std::map<std::string, std::string>> texts;
  std::size_t name_width = 16;
  for (const Cell& cell : cells) {
    if (std::count(columns.begin(), columns.end(), cell.column) == 0) columns.push_back(cell.column);
    if (texts.count(cell.row) == 0) names.push_back(cell.row);
    texts[cell.row][cell.column] = cell.text;
    name_width = std::max(name_width, cell.row.size() + 2);
  }
  std::string table = padded(title, name_width);
  for (const std::string& column : columns) table += padded(column, kColumnWidth);
  for (const std::string& name : names) {
    table += "\n" + padded(name, name_width);
    for (const std::string& column : columns) table += padded(texts[name][column], kColumnWidth);
  }
  return table;
}

}  // namespace

void ProgressLog::update(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  const std::size_t done = counts.evaluatedPoses();
  if (!has_begun_ && done > 0) {
    has_begun_ = true;
    first_progress_ = now;
    first_completed_ = done;
  }
  if ((now - last_line_).toSec() < kSecondsBetweenLines) return;
  last_line_ = now;
  std::string line = "evaluated " + std::to_string(done);
  const std::size_t expected = options.poses.size();
  if (expected > 0) {
    line += " of " + std::to_string(expected) + " poses (" + std::to_string(100 * done / expected) + " %)";
    const double elapsed_s = has_begun_ ? (now - first_progress_).toSec() : 0.0;
    if (done > first_completed_ && done < expected) {
      const double each_s = elapsed_s / static_cast<double>(done - first_completed_);
      line += ", " + textOfDuration(each_s * static_cast<double>(expected - done)) + " left";
    }
  } else {
    line += " poses";
  }
  line += "; " + std::to_string(counts.queued_poses) + " in work, " + std::to_string(counts.waiting_images) +
          (counts.awaits_truth ? " images wait for camera/pose, camera/depth/image_raw or camera_info"
                               : " images wait for a partner");
  ROS_INFO("%s", line.c_str());
}

double WorkLog::secondsLeft(std::size_t done) const {
  const double each_s = (ros::SteadyTime::now() - start_).toSec() / static_cast<double>(done);
  return each_s * static_cast<double>(all_ - done);
}

void WorkLog::update(std::size_t done) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if ((now - last_line_).toSec() < kSecondsBetweenLines || done == 0) return;
  last_line_ = now;
  ROS_INFO("%zu of %zu %s (%zu %%), %s left", done, all_, work_.c_str(), 100 * done / all_,
           textOfDuration(secondsLeft(done)).c_str());
}

std::string summaryTable(const std::vector<evaluate::SummaryRow>& rows) {
  std::vector<Cell> cells;
  for (const evaluate::SummaryRow& row : rows) {
    char text[80];
    std::snprintf(text, sizeof text, "%.5f (s %.5f)", row.statistics.mean, row.statistics.sd);
    cells.push_back({row.a + "-" + row.b, row.difference, text});
  }
  return tableOf("mean D", cells);
}

std::string verifiedTable(const std::vector<evaluate::VerifiedSummaryRow>& rows) {
  const std::set<std::string> shown = {"precision_3px",      "recall_3px", "average_precision_3px",
                                       "matching_score_3px", "mma_3px",    "repeatability"};
  std::vector<Cell> cells;
  for (const evaluate::VerifiedSummaryRow& row : rows) {
    if (shown.count(row.measure) == 0) continue;
    char text[80];
    std::snprintf(text, sizeof text, "%.3f [%.3f, %.3f]", row.statistics.mean, row.statistics.ci_low,
                  row.statistics.ci_high);
    cells.push_back({row.a + "-" + row.b, row.detector + " " + row.measure, text});
  }
  return cells.empty() ? "" : "\n" + tableOf("right matches", cells);
}

std::string localisationTable(const std::vector<evaluate::LocalisationSummary>& summaries) {
  std::string table = "map      query    detector      n  failed";
  char buffer[200];
  for (const evaluate::Reach& reach : evaluate::kReaches) {
    std::snprintf(buffer, sizeof buffer, "  %5.4g m %2.4g deg", reach.metres, reach.degrees);
    table += buffer;
  }
  table += "  median m    deg  AUC@5/10/20 deg";
  for (const evaluate::LocalisationSummary& s : summaries) {
    std::snprintf(buffer, sizeof buffer, "\n%-8s %-8s %-9s %5zu  %6zu", s.map.c_str(), s.query.c_str(),
                  s.detector.c_str(), s.n, s.failures);
    table += buffer;
    for (const evaluate::Statistics& within : s.within) {
      std::snprintf(buffer, sizeof buffer, "  %12.1f %%", 100.0 * within.mean);
      table += buffer;
    }
    std::snprintf(buffer, sizeof buffer, "  %8.3f %6.3f  %.3f/%.3f/%.3f", s.median_error_m,
                  s.median_error_deg, s.auc[0], s.auc[1], s.auc[2]);
    table += buffer;
  }
  return table;
}

std::string faultsOf(const evaluate::LocalisationOutcome& outcome) {
  if (outcome.isWhole()) return "";
  std::string line;
  const auto add = [&](const std::string& text) { line += (line.empty() ? "" : "; ") + text; };
  if (!outcome.uncompared.empty())
    add("not localised, since no image of it was evaluated in a pair: " + commaList(outcome.uncompared));
  if (!outcome.unplaced.empty())
    add("no query can be found by " + commaList(outcome.unplaced) +
        ", since depth tells the place of none of the features in the map: is it of the map's camera, in m "
        "or mm, and not 0?");
  if (outcome.key_frames == 0)
    add("nothing localised: the map has no key frame, for which its images must be evaluated in a pair, and "
        "depth, pose and camera_info have come with them");
  if (outcome.key_frames > 0 && outcome.unobserved > 0)
    add(std::to_string(outcome.unobserved) +
        " queries were not looked for, for want of pose or camera_info: see problems.csv");
  return line;
}

std::string faultOfStamps(const evaluate::StreamCounts& counts) {
  if (!counts.isMostlyDuplicate()) return "";
  if (!counts.only_stamp_ns) {
    return std::to_string(counts.duplicate) + " of " + std::to_string(counts.received) +
           " images have a stamp that had come before, and were left out";
  }
  return "all " + std::to_string(counts.received) + " images have stamp " +
         textOfStamp(timeOf(*counts.only_stamp_ns)) +
         ", so that one counts: does the driver set header.stamp?";
}

namespace {

std::string faultOfSuns(const evaluate::StreamCounts& counts) {
  if (counts.other_sun == 0) return "";
  return std::to_string(counts.other_sun) + " images under another sun than the first, as of " +
         counts.other_sun_fault;
}

}  // namespace

std::string faultsOf(const evaluate::EvaluationOptions& options, const evaluate::Outcome& outcome) {
  if (outcome.isWhole()) return "";
  std::string of_streams;
  for (std::size_t s = 0; s < options.streams.size(); ++s) {
    const evaluate::StreamCounts& counts = outcome.counts.streams[s];
    for (const std::string& fault : {faultOfStamps(counts), faultOfSuns(counts)})
      if (!fault.empty()) of_streams += (of_streams.empty() ? "" : "; ") + options.streams[s] + ": " + fault;
  }
  std::string line;
  const auto add = [&](const std::string& name, std::size_t count) {
    if (count > 0) line += (line.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  };
  add("expected poses never came", outcome.absent_poses);
  add("left out by earlier or merged runs, and not asked for now", outcome.not_mended);
  for (std::size_t p = 0; p < options.pairs.size(); ++p) {
    const evaluate::PairCounts& c = outcome.counts.pairs[p];
    const std::string pair = " (" + options.pairs[p].a + "-" + options.pairs[p].b + ")";
    add("missing_partner" + pair, c.missing_partner);
    add("undecodable" + pair, c.undecodable);
    add("size_mismatch" + pair, c.size_mismatch);
    add("dropped" + pair, c.dropped);
    add("failed" + pair, c.failed);
    add("unplaced" + pair, c.unplaced);
    add("duplicate" + pair, c.duplicate);
    add("other_sun" + pair, c.other_sun);
    add("two_places" + pair, c.two_places);
  }
  if (line.empty()) return of_streams.empty() ? "no pair of images came at all" : of_streams;
  return of_streams + (of_streams.empty() ? "" : "; ") + "not evaluated: " + line + "; each is named in " +
         options.output_dir + "/problems.csv";
}

std::string drawnReport(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts,
                        const evaluate::StopToken& stop) {
  const bool has_any =
      std::any_of(counts.pairs.begin(), counts.pairs.end(),
                  [](const evaluate::PairCounts& pair) { return pair.evaluated + pair.resumed > 0; });
  const std::string& folder = options.output_dir;
  if (!has_any || evaluate::drawReport(folder, evaluate::ReportTables::kHidden, stop)) return "";
  return folder + ": the results are there, but report.html was not drawn; rosrun sunlit report " + folder +
         " does it";
}

std::string remarksOf(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts) {
  std::string line;
  const auto add = [&](std::size_t count, const char* what, const std::string& stream) {
    if (count > 0)
      line += (line.empty() ? "" : "; ") + stream + ": " + std::to_string(count) + " images " + what;
  };
  for (std::size_t s = 0; s < options.streams.size(); ++s) {
    const evaluate::StreamCounts& c = counts.streams[s];
    add(c.dropped, "dropped, since memory_limit was reached", options.streams[s]);
    if (!c.isMostlyDuplicate())  // else it is a fault
      add(c.duplicate, "of a stamp that had come before, left out", options.streams[s]);
    add(c.late, "late, after their stamp had been given up", options.streams[s]);
    add(c.lost, "missing by their sequence numbers (lost, or left out by a throttle)", options.streams[s]);
    add(c.unexpected, "of poses that are not expected, left out", options.streams[s]);
    add(c.lossy, "compressed with loss (JPEG)", options.streams[s]);
    if (c.no_features > 0)
      line += (line.empty() ? "" : "; ") + options.streams[s] + ": " + std::to_string(c.no_features) +
              " times a detector found nothing in an image (no_features)";
    add(c.unlocalised,
        "not localised, for want of a usable depth, pose or camera, or since a detector failed",
        options.streams[s]);
  }
  return line;
}

}  // namespace sunlit::ros_interface
