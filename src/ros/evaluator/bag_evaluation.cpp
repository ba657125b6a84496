#include "ros/evaluator/bag_evaluation.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "ros/conversions/evaluation.h"
#include "ros/conversions/received_images.h"
#include "ros/evaluator/bag_cameras.h"
#include "ros/evaluator/bag_list.h"
#include "ros/evaluator/bag_message.h"
#include "ros/evaluator/bag_topics.h"
#include "ros/evaluator/folder_lock.h"
#include "ros/evaluator/pose_frames.h"
#include "ros/evaluator/progress_log.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

// Enough to keep all processors busy, few enough to keep the memory flat.
constexpr std::size_t kPosesInWork = 8;

/// What the images wait for, all in vain: better said now than once the bags are read.
void requireToLocaliseBy(const evaluate::EvaluationOptions& options, const std::string& root,
                         const std::set<std::string>& held) {
  if (options.localisation.map.empty()) return;
  std::vector<std::string> needed = {root + topics::kDepth, root + topics::kPose};
  for (const auto& streams : {mapStreamsOf(options.localisation), queriesOf(options)}) {
    for (const std::string& stream : streams) needed.push_back(topicOf(root, stream, topics::kCameraInfo));
  }
  std::set<std::string> absent;
  for (const std::string& topic : needed) {
    if (held.count(topic) == 0) absent.insert(topic);
  }
  if (!absent.empty()) {
    throw std::runtime_error("localisation/map is \"" + options.localisation.map +
                             "\", but must be empty for bags without " + topicsInWords(absent) +
                             "; they hold: " + topicsInWords(held));
  }
}

/// Which poses are every n-th only captures or a rate tell: better said now than of each image at the end.
void requireToCountBy(const evaluate::EvaluationOptions& options, const std::string& root,
                      const std::set<std::string>& held) {
  const evaluate::PairSpec* const thinned = thinnedPair(options);
  if (thinned == nullptr || options.frame_rate > 0.0) return;
  std::set<std::string> captures;
  for (const std::string& stream : options.streams) captures.insert(topicOf(root, stream, topics::kCapture));
  const bool has_any = std::any_of(captures.begin(), captures.end(),
                                   [&](const std::string& topic) { return held.count(topic) != 0; });
  if (has_any) return;
  throw std::runtime_error("every of the pair " + thinned->name() + " is " + std::to_string(thinned->every) +
                           ", but must be 1 for bags without " + topicsInWords(captures) +
                           ", unless frame_rate and stamp_start tell which pose an image is of; they hold: " +
                           topicsInWords(held));
}

std::vector<std::string> camerasOf(const evaluate::EvaluationOptions& options, const std::string& root) {
  std::vector<std::string> topics;
  for (const std::string& stream : options.streams)
    topics.push_back(topicOf(root, stream, topics::kCameraInfo));
  return topics;
}

void warnOfNothingIn(const std::string& bag, const std::vector<std::string>& wanted) {
  const std::set<std::string> held = topicsIn({bag});
  if (std::any_of(wanted.begin(), wanted.end(),
                  [&](const std::string& topic) { return held.count(topic) != 0; }))
    return;
  std::fprintf(stderr, "warning: %s brings nothing: it holds none of %s; it holds: %s\n", bag.c_str(),
               topicsInWords({wanted.begin(), wanted.end()}).c_str(), topicsInWords(held).c_str());
}

class BagSource {
 public:
  explicit BagSource(const BagEvaluationOptions& options)
      : max_pixels_(options.intake.max_pixels), paths_(options.bags) {
    const std::string root = rootOf(options.name_space);
    const std::set<std::string> held = topicsIn(options.bags);
    requireToLocaliseBy(options.evaluation, root, held);
    requireToCountBy(options.evaluation, root, held);
    requireOneCamera(options.bags, camerasOf(options.evaluation, root));
    place_topic_ = root + topics::kPose;
    std::vector<std::string> wanted = {place_topic_};
    for (std::size_t s = 0; s < options.evaluation.streams.size(); ++s) {
      const std::string& stream = options.evaluation.streams[s];
      wanted.push_back(imageTopic(root, stream, options.intake.transport, held));
      images_[wanted.back()] = s;
      wanted.push_back(topicOf(root, stream, topics::kCapture));
      captures_[wanted.back()] = s;
      if (options.evaluation.localisation.map.empty()) continue;
      wanted.push_back(topicOf(root, stream, topics::kCameraInfo));
      cameras_[wanted.back()] = s;
    }
    if (!cameras_.empty()) wanted.push_back(root + topics::kDepth);
    for (const std::string& path : options.bags) {
      warnOfNothingIn(path, wanted);
      bags_.push_back(openBag(path));
      requireImages(path);
      view_.addQuery(*bags_.back(), topicQuery(wanted));
      rosbag::View places(*bags_.back(), topicQuery({place_topic_}));
      for (const rosbag::ConnectionInfo* connection : places.getConnections())
        bags_of_places_[connection->header.get()] = path;
    }
  }

  const std::vector<std::unique_ptr<rosbag::Bag>>& bags() const { return bags_; }

  /// Throws where the folder of `lock` was taken away meanwhile, too.
  void feed(evaluate::Evaluation& evaluation, const FolderLock& lock) {
    try {
      feedAll(evaluation, lock);
    } catch (const ros::Exception&) {
      tellDamaged();
      throw;
    }
  }

 private:
  /// Which bag cannot be read whole: throws as readingBag() does.
  void tellDamaged() const {
    for (std::size_t i = 0; i < bags_.size(); ++i) {
      readingBag(paths_[i], [&] {
        rosbag::View all(*bags_[i]);
        std::vector<std::uint8_t> bytes;
        for (const rosbag::MessageInstance& instance : all) {
          bytes.resize(instance.size());
          ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
          instance.write(out);
        }
      });
    }
  }

  /// Before the first is looked at, which may be hours later.
  void requireImages(const std::string& path) const {
    for (const auto& [topic, type] : typesOfTopics(*bags_.back())) {
      if (images_.count(topic) > 0) requireImage(path + ": " + topic, type, true);
    }
  }

  void feedAll(evaluate::Evaluation& evaluation, const FolderLock& lock) {
    for (const rosbag::MessageInstance& instance : view_) {
      const std::string topic = withSlash(instance.getTopic());
      if (const auto found = images_.find(topic); found != images_.end()) {
        feedImage(evaluation, found->second, instance);
      } else if (const auto capture = captures_.find(topic); capture != captures_.end()) {
        evaluation.addCapture(capture->second, captureOf(*messageOf<Capture>(instance)));
      } else if (const auto camera = cameras_.find(topic); camera != cameras_.end()) {
        const auto message = messageOf<sensor_msgs::CameraInfo>(instance);
        evaluation.addCamera(camera->second, nanosecondsOf(message->header.stamp),
                             cameraOf(*message, topics::kImage));
      } else if (topic != place_topic_) {
        const auto depth = messageOf<sensor_msgs::Image>(instance);
        evaluation.addDepth(nanosecondsOf(depth->header.stamp), depthOf(*depth, max_pixels_));
      } else {
        const auto message = messageOf<geometry_msgs::PoseStamped>(instance);
        noteFrame(evaluation, message->header, bags_of_places_.at(instance.getConnectionHeader().get()));
        evaluation.addPlace(placeOf(*message));
        evaluation.addTruePose(nanosecondsOf(message->header.stamp), truePoseOf(*message));
      }
      evaluation.waitForRoom(kPosesInWork);
      lock.requireInPlace();
      log_.update(evaluation.options(), evaluation.counts());
    }
  }

  void feedImage(evaluate::Evaluation& evaluation, std::size_t stream,
                 const rosbag::MessageInstance& instance) const {
    if (const auto message = instance.instantiate<sensor_msgs::CompressedImage>())
      return feedDecoded(evaluation, stream, message->header, decode(*message, max_pixels_));
    const auto message = messageOf<sensor_msgs::Image>(instance);
    feedDecoded(evaluation, stream, message->header, decode(*message, max_pixels_));
  }

  void noteFrame(evaluate::Evaluation& evaluation, const std_msgs::Header& header, const std::string& bag) {
    const std::string warning = frames_.note(header.frame_id, place_topic_ + " of " + bag);
    if (warning.empty()) return;
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
    evaluation.addPoseProblem(nanosecondsOf(header.stamp), kOtherFrame, warning);
  }

  static void feedDecoded(evaluate::Evaluation& evaluation, std::size_t stream,
                          const std_msgs::Header& header, const DecodedImage& decoded) {
    const std::int64_t stamp_ns = nanosecondsOf(header.stamp);
    if (!decoded.fault.empty()) {
      evaluation.addBadImage(stream, stamp_ns, decoded.fault);
    } else {
      evaluation.addImage(stream, stamp_ns, decoded.rgb, decoded.traits);
    }
  }

  std::size_t max_pixels_;
  PoseFrames frames_;
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<rosbag::Bag>> bags_;  ///< of these
  rosbag::View view_;
  std::map<std::string, std::size_t> images_;
  std::map<std::string, std::size_t> captures_;
  std::map<std::string, std::size_t> cameras_;  ///< where it is localised
  std::string place_topic_;
  std::map<const ros::M_string*, std::string> bags_of_places_;  ///< by what messages bear of a connection
  ProgressLog log_;
};

}  // namespace

std::vector<Field> fieldsOf(BagEvaluationOptions& options) {
  return {fieldOf(fieldsOf(options.evaluation), "output_dir"),
          {"namespace",
           &options.name_space,
           "",
           {},
           "of the topics: NAME/<stream>/camera/image_raw, or that with /compressed"},
          {"merge",
           &options.evaluation.merge,
           "",
           {},
           "takes over the values of a run of other poses with the same parameters, made on another machine, "
           "say; may be repeated"}};
}

namespace {

evaluate::LocalisationOutcome localise(evaluate::Evaluation& evaluation) {
  QueryLog log;
  evaluate::LocaliseCallbacks callbacks;
  callbacks.progress = [&](std::size_t done, std::size_t all) { log.update(done, all); };
  const evaluate::LocalisationOutcome outcome = evaluation.localise(callbacks);
  if (!outcome.summary.empty()) std::printf("\n%s\n", localisationTable(outcome.summary).c_str());
  return outcome;
}

}  // namespace

int evaluateBags(const BagEvaluationOptions& options) {
  std::optional<BagSource> source;
  if (!options.bags.empty()) source.emplace(options);
  evaluate::EvaluationCallbacks callbacks;
  callbacks.note = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  const FolderLock lock(options.evaluation.output_dir);
  if (source) requireSameBags(options.evaluation.output_dir, source->bags());
  evaluate::Evaluation evaluation(options.evaluation, callbacks);
  if (source) noteBags(options.evaluation.output_dir, source->bags());
  if (source) source->feed(evaluation, lock);
  const evaluate::Outcome outcome = evaluation.finish();
  std::printf("%zu poses in %s\n%s%s\n", outcome.counts.evaluatedPoses(),
              options.evaluation.output_dir.c_str(), summaryTable(outcome.summary).c_str(),
              verifiedTable(outcome.verified).c_str());
  const std::string remarks = remarksOf(evaluation.options(), outcome.counts);
  if (!remarks.empty()) std::fprintf(stderr, "%s\n", remarks.c_str());
  const evaluate::LocalisationOutcome localised = localise(evaluation);
  evaluation.compareMethods();
  const std::string unreported =
      options.report ? drawnReport(evaluation.options(), outcome.counts) : std::string();
  if (!unreported.empty()) std::fprintf(stderr, "%s\n", unreported.c_str());
  std::string faults = faultsOf(evaluation.options(), outcome);
  const std::string of_queries = faultsOf(localised);
  faults += (faults.empty() || of_queries.empty() ? "" : "; ") + of_queries;
  if (faults.empty()) return 0;
  std::fprintf(stderr, "%s\n", faults.c_str());
  return kNotWholeStatus;
}

}  // namespace sunlit::ros_interface
