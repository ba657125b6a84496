/// What a person in front of the terminal reads.
#pragma once

#include <ros/time.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::ros_interface {

/// Exit status of a program that could not evaluate some pairs.
constexpr int kNotWholeStatus = 3;

/// A line of progress about every ten seconds.
class ProgressLog {
 public:
  /// Logs if it is time to.
  void update(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts);

 private:
  ros::SteadyTime last_line_ = ros::SteadyTime::now();
  ros::SteadyTime first_progress_;
  std::size_t first_completed_ = 0;
  bool has_begun_ = false;
};

/// The same of a work of known size.
class WorkLog {
 public:
  /// `work` as in "queries localised".
  WorkLog(std::string work, std::size_t all) : work_(std::move(work)), all_(all) {}
  void update(std::size_t done);
  /// As fast as it went so far; `done` is above 0.
  double secondsLeft(std::size_t done) const;

 private:
  std::string work_;
  std::size_t all_;
  ros::SteadyTime start_ = ros::SteadyTime::now();
  ros::SteadyTime last_line_ = start_;
};

/// The same of queries that are looked for in a map.
class QueryLog {
 public:
  void update(std::size_t done, std::size_t all) {
    if (!log_) log_.emplace("queries localised", all);
    log_->update(done);
  }
  double secondsLeft(std::size_t done) const { return log_->secondsLeft(done); }

 private:
  std::optional<WorkLog> log_;
};

/// Means and standard deviations, one line a difference, one column a pair.
std::string summaryTable(const std::vector<evaluate::SummaryRow>& rows);
/// Means and intervals of what is worth a look, below a line end; empty where no matches were verified.
std::string verifiedTable(const std::vector<evaluate::VerifiedSummaryRow>& rows);
/// How well queries were found, one line a query stream and detector.
std::string localisationTable(const std::vector<evaluate::LocalisationSummary>& summaries);
/// One line of what kept queries from being looked for; empty where nothing did.
std::string faultsOf(const evaluate::LocalisationOutcome& outcome);
/// Of a stream whose images were mostly left out, since their stamps had come before; empty for any other.
std::string faultOfStamps(const evaluate::StreamCounts& counts);
/// One line of counts of what could not be evaluated; empty where everything was.
std::string faultsOf(const evaluate::EvaluationOptions& options, const evaluate::Outcome& outcome);

/// Draws report.html, unless nothing was evaluated, of which there is none. One line where that failed, else
/// empty. Throws evaluate::Stopped as drawReport() does.
std::string drawnReport(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts,
                        const evaluate::StopToken& stop = {});
/// One line of what came and was not used, never came, or was compressed with loss, by stream; empty where
/// nothing was.
std::string remarksOf(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts);

}  // namespace sunlit::ros_interface
