/// All streams of a camera: for each condition its sky in and its images out, and what all conditions share.
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros/render/condition_output.h"
#include "ros/render/options.h"
#include "ros/render/pose_output.h"
#include "ros/render/sky_input.h"
#include "sunlit/image/exposure_lag.h"
#include "sunlit/ros/conditions.h"
#include "sunlit/scene/world_site.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"

namespace sunlit::ros_interface {

/// One place and moment to be photographed.
struct Shot {
  int pose_index = 0;
  ros::Time stamp;
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  render::BodyPlaces map_from_links = {};  ///< of the robot; empty: it is not there
  Motion motion = {};                      ///< of the camera, with the robot
  std::int64_t chance = 0;  ///< what makes its grain and drops of rain differ from other shots' of its drive
  std::string drive = {};   ///< image::PictureName::drive
};

struct StreamOptions {
  OutputOptions output;
  bool night = true;  ///< moon and stars too
  SkyRule sky = SkyRule::kAround;
  std::string sun_namespace;  ///< of the topics c/sun, c/moon and c/celestial; empty: the node's own
  WantedSubscribers wanted_subscribers;
};

/// What became of one condition so far.
struct StreamState {
  std::string condition;   ///< empty: the only one, without a name
  std::size_t images = 0;  ///< sent
  ros::Time stamp = {};    ///< of the newest
  double ev100 = 0.0;      ///< of the newest
  std::size_t black = 0;   ///< images sent that are black all over
  bool is_black = false;   ///< the newest
};

class Streams {
 public:
  /// `studio` and `sky` outlive this.
  Streams(const RenderConditions& conditions, const StreamOptions& options, studio::Studio& studio,
          studio::Sky& sky);

  /// Renders the shot under every condition's sky of its stamp and publishes all of it with that. Only when
  /// every sky is there; stamps never go back by more than a clock does. Meanwhile draws the geometry of the
  /// next shot, if there is one, since drawing leaves cores idle.
  void take(const Shot& shot, const std::optional<Shot>& next = std::nullopt);
  /// The first picture before that of pose `index` which an exposure that lags must meter() before it;
  /// `index` itself where none is missing.
  std::int64_t firstUnmetered(std::int64_t index) const;
  /// Lets exposures that lag see what nobody gets a picture of, where they miss it before `target`, under
  /// whose sky it is metered.
  void meter(const Shot& shot, const Shot& target);
  /// One image of `condition` under its newest sky, exposed as if it had been looking there for long. Throws
  /// std::invalid_argument naming what is wrong with the condition.
  Photograph view(const Shot& shot, const std::string& condition);

  /// Of conditions.
  std::size_t size() const { return streams_.size(); }
  std::size_t poses() const { return poses_; }  ///< taken
  /// Of these, those with a studio::ViewFault, by what they do.
  const std::map<std::string, std::size_t>& faultyPoses() const { return faulty_poses_; }
  const StreamState& state(std::size_t index) const { return streams_[index]->state; }
  /// Messages of its sky that could not be used.
  std::size_t refusedSkies(std::size_t index) const { return streams_[index]->sky.refused(); }
  /// As SkyInput has them.
  bool isRefusingSkies(std::size_t index) const { return streams_[index]->sky.isRefusing(); }
  std::string mixedSkyTopics(std::size_t index) const { return streams_[index]->sky.mixedTopics(); }

  const PoseOutput& poseOutput() const { return pose_output_; }
  /// Of the place of the first condition, m; only when every sky is there.
  double siteElevation() const { return streams_.front()->sky.newest()->site_elevation_m; }
  /// Whether that place is `world`'s, as studio::isSkyOver() has it; no sun without a time is.
  bool isOver(const scene::WorldSite& world) const;
  /// The condition of which nothing was heard yet, and what is missing, in words; empty if nothing is.
  std::string waitsForSky() const;
  /// What is missing before an image of that stamp can be taken; empty if nothing is.
  Wait waitsForSky(const ros::Time& stamp) const;
  /// Whether it will never come.
  bool missedSky(const ros::Time& stamp) const;
  /// Of the newest sky that is there; every sky is.
  ros::Time newestSky() const;
  /// s between the two skies around `stamp`, at most: the longest that a picture waits for one that moves.
  double skySpacing(const ros::Time& stamp) const;
  /// What is missing before a first image would reach everybody, in words; empty if nothing is.
  std::string waitsForSubscribers() const;

 private:
  struct Stream {
    Stream(const RenderConditions& conditions, std::size_t index, const StreamOptions& options,
           const studio::Sky& skies);
    /// In what its picture is taken that metered so much, in its turn.
    studio::Setting inTurn(std::int64_t index);
    void count(const Photograph& photograph);
    std::string name;
    sky::Weather weather;     ///< at the stamp that `light` is of
    studio::Setting setting;  ///< of a picture by itself
    std::string exposure_mode;
    image::ExposureLag lag;
    SkyInput sky;
    ConditionOutput output;
    std::optional<light::Illumination> light;
    SkyBodies lit_by;  ///< what `light` was made from
    StreamState state;
  };
  /// Made anew only when something in the sky has moved.
  const light::Illumination& lightOf(Stream& stream, const SkyBodies& bodies, const ros::Time& stamp);
  /// Lights and publishes what the studio looks at.
  void expose(const Shot& shot);
  Stream& find(const std::string& condition);
  void countView(const Shot& shot);

  studio::Studio& studio_;
  studio::Sky& sky_;
  WantedSubscribers wanted_;
  PoseOutput pose_output_;
  std::size_t poses_ = 0;
  std::map<std::string, std::size_t> faulty_poses_;
  std::vector<std::unique_ptr<Stream>> streams_;
};

}  // namespace sunlit::ros_interface
