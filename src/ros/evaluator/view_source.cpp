#include "ros/evaluator/view_source.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "ros/evaluator/progress_log.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::ros_interface {
namespace {

/// Views that are in memory at once: enough for all processors, few enough for any memory.
constexpr std::size_t kViewsAtOnce = 16;
constexpr std::size_t kProblemsShown = 5;
constexpr const char* kProblemsFile = "/localisation_problems.csv";

}  // namespace

std::unique_ptr<BagViews> ViewSource::open(const BagStream& stream) const {
  std::printf("reading %s of %s\n", stream.name.c_str(), stream.bag.c_str());
  std::fflush(stdout);
  auto views = std::make_unique<BagViews>(stream, options_.topics, options_.intake);
  if (!views->repeated().empty())
    std::printf("%s: %zu images left out, whose stamps repeat\n", stream.name.c_str(),
                views->repeated().size());
  if (views->repeatedDepths() > 0)
    std::printf("%s: %zu pictures of depth left out, whose stamps repeat\n", stream.name.c_str(),
                views->repeatedDepths());
  return views;
}

void ViewSource::noteFrames(const BagViews& views, bool is_of_map) {
  if (options_.has_frame_a_stream) frames_ = {};
  const auto warn = [&](std::int64_t stamp_ns, const std::string& warning) {
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
    problems_.push_back({views.stream().name, is_of_map, stamp_ns, kOtherFrame + (": " + warning), true});
  };
  for (const auto& [frame, stamp_ns] : views.frames()) {
    const std::string warning = frames_.note(frame, views.posesTopic() + " of " + views.stream().bag);
    if (!warning.empty()) warn(stamp_ns, warning);
  }
  for (const std::string& warning : views.framesApart(is_of_map)) warn(views.entries()[0].stamp_ns, warning);
}

std::vector<std::size_t> ViewSource::usable(const BagViews& views, bool needs_depth) {
  noteFrames(views, needs_depth);
  evaluate::StreamCounts counts;
  counts.received = views.entries().size() + views.repeated().size();
  counts.duplicate = views.repeated().size();
  for (const std::int64_t stamp_ns : views.repeated())
    problems_.push_back({views.stream().name, needs_depth, stamp_ns,
                         "duplicate: this stamp had come before; the first image counts", true});
  if (views.entries().size() == 1) counts.only_stamp_ns = views.entries()[0].stamp_ns;
  if (const std::string fault = faultOfStamps(counts); !fault.empty())
    addProblem(views.stream(), needs_depth, views.entries()[0].stamp_ns, fault);
  std::vector<std::size_t> entries;
  for (std::size_t i = 0; i < views.entries().size(); ++i) {
    const BagViews::Entry& entry = views.entries()[i];
    const bool lacks_depth = entry.fault.empty() && needs_depth && !entry.depth_stamp_ns;
    const std::string fault = lacks_depth ? views.lackOfDepth(entry) : entry.fault;
    if (fault.empty()) {
      entries.push_back(i);
    } else {
      addProblem(views.stream(), needs_depth, entry.stamp_ns, fault);
    }
  }
  return entries;
}

void ViewSource::forEach(const BagViews& views, const std::vector<std::size_t>& entries, const Job& job) {
  WorkLog log(job.work, entries.size());
  for (std::size_t first = 0; first < entries.size(); first += kViewsAtOnce) {
    const std::size_t end = std::min(first + kViewsAtOnce, entries.size());
    std::vector<std::size_t> which;
    std::vector<evaluate::PosedView> read;
    for (std::size_t i = first; i < end; ++i) {
      BagViews::Read one = views.read(entries[i], job.needs_depth);
      if (one.fault.empty()) {
        which.push_back(entries[i]);
        read.push_back(one.view);
      } else {
        addProblem(views.stream(), job.needs_depth, views.entries()[entries[i]].stamp_ns, one.fault);
      }
    }
    for (const auto& [view_and_detector, fault] : job.hand(which, read))
      addProblem(views.stream(), job.needs_depth, views.entries()[which[view_and_detector.first]].stamp_ns,
                 fault);
    log.update(end);
    lock_.requireInPlace();
  }
}

void ViewSource::addProblem(const BagStream& stream, bool needs_depth, std::int64_t stamp_ns,
                            const std::string& fault) {
  problems_.push_back({stream.name, needs_depth, stamp_ns, fault});
}

void ViewSource::addFeatureless(const BagStream& stream, bool is_of_map, std::int64_t stamp_ns,
                                const std::string& detector) {
  ++featureless_;
  const std::string of_depth = is_of_map ? " whose place its depth tells" : "";
  problems_.push_back({stream.name, is_of_map, stamp_ns,
                       "no_features: " + detector + " found nothing in it" + of_depth, true});
}

std::vector<evaluate::LocalisationProblem> ViewSource::unusable() const {
  std::vector<evaluate::LocalisationProblem> all;
  std::copy_if(problems_.begin(), problems_.end(), std::back_inserter(all),
               [](const evaluate::LocalisationProblem& problem) { return !problem.is_used; });
  return all;
}

std::string ViewSource::problemsInWords() const {
  const std::vector<evaluate::LocalisationProblem> all = unusable();
  if (all.empty()) return "there is none";
  std::set<std::pair<std::string, std::int64_t>> images;  // of which several detectors may fail
  for (const evaluate::LocalisationProblem& problem : all) images.emplace(problem.stream, problem.stamp_ns);
  std::string text = std::to_string(images.size()) + " images could not be used (" + options_.output_dir +
                     kProblemsFile + "): ";
  std::vector<std::pair<const evaluate::LocalisationProblem*, std::size_t>> kinds;  // the first, how many
  std::map<std::pair<std::string, std::string>, std::size_t> numbers;
  for (const evaluate::LocalisationProblem& problem : all) {
    const auto [known, is_new] = numbers.emplace(std::make_pair(problem.stream, problem.fault), kinds.size());
    if (is_new) kinds.emplace_back(&problem, 0);
    ++kinds[known->second].second;
  }
  for (std::size_t i = 0; i < std::min(kinds.size(), kProblemsShown); ++i) {
    const auto& [problem, count] = kinds[i];
    text += (i == 0 ? "" : "; ") + problem->stream + " at " + textOfStamp(timeOf(problem->stamp_ns)) +
            (count > 1 ? " and " + std::to_string(count - 1) + " more" : "") + ": " + problem->fault;
  }
  return text + (kinds.size() > kProblemsShown ? "; …" : "");
}

void ViewSource::writeProblems() const {
  writeLocalisationProblems(options_.output_dir + kProblemsFile, problems_);
}

void ViewSource::fail(const std::string& what) const {
  writeProblems();
  throw std::runtime_error(what + ": " + problemsInWords());
}

int ViewSource::finish() const {
  writeProblems();
  if (featureless_ > 0)
    std::fprintf(stderr, "%zu times a detector found nothing in an image (%s%s)\n", featureless_,
                 options_.output_dir.c_str(), kProblemsFile);
  if (unusable().empty()) return 0;
  std::fprintf(stderr, "%s\n", problemsInWords().c_str());
  return kNotWholeStatus;
}

evaluate::StampedPose poseOfLink(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical) {
  const Eigen::Isometry3d map_from_link = map_from_optical * linkFromOptical().inverse();
  return {stamp_ns, map_from_link.translation(), Eigen::Quaterniond(map_from_link.linear())};
}

}  // namespace sunlit::ros_interface
