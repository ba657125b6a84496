#include "tools/atlas_observe.h"

#include <cstdio>
#include <filesystem>
#include <set>
#include <utility>

#include "sunlit/image/files.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/studio/sky.h"
#include "tools/terminal.h"

namespace sunlit::tools {

namespace {

using evaluate::ObservationFile;
using WholePictures = std::set<std::pair<std::string, std::int64_t>>;

PlaceOptions placeOf(const AtlasRunOptions& options, const AtlasCondition& condition) {
  PlaceOptions place = options.place;
  place.date = condition.date;
  return place;
}

std::string lineOf(const AtlasCondition& condition, const studio::SkyBodies& bodies, double illuminance_lx) {
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, "%.6f,%.6f,%.6g", bodies.sun.apparent.azimuth().deg(),
                bodies.sun.apparent.elevation().deg(), illuminance_lx);
  return condition.name + ',' + textOfDate(condition.date) + ',' + condition.time.clock() + ',' + numbers +
         '\n';
}

/// Of the unit's lights, those in which the pose is not whole yet.
std::vector<std::size_t> lightsMissing(const AtlasRunOptions& options, const ObserveUnit& unit,
                                       const AtlasPose& pose, const WholePictures& whole) {
  std::vector<std::size_t> missing;
  for (std::size_t c = unit.first_condition; c < unit.end_condition; ++c) {
    const std::string& name = options.conditions[c].name;
    const std::string last = options.atlas.has_query_drive ? evaluate::queryDriveOf(name) : name;
    if (whole.count({last, pose.number}) == 0) missing.push_back(c);
  }
  return missing;
}

WholePictures wholeIn(const AtlasRunOptions& options, const ObservationFile& file) {
  return evaluate::observedWhole(file, options.atlas.verify.detectors.size());
}

}  // namespace

AtlasCamera::AtlasCamera(const AtlasRunOptions& options)
    : options_(options), studio_(options.studio, std::nullopt, onTerminal()) {
  studio::Sky sky = skyOver(studio_, options.place);
  for (const AtlasCondition& condition : options.conditions) {
    const studio::SkyBodies bodies = bodiesOf(placeOf(options, condition), condition.time.hour());
    const sky::Daylight daylight = sky.daylight(bodies, weatherAt(options.place, condition.time.hour()));
    lights_.push_back(studio_.illumination(daylight));
    lines_.push_back(lineOf(condition, bodies, daylight.groundIlluminance().luminance()));
  }
}

evaluate::AtlasView AtlasCamera::viewFrom(const Eigen::Isometry3d& map_from_camera,
                                          const image::PictureName& place,
                                          const std::vector<std::size_t>& conditions) {
  studio_.look(map_from_camera);
  blind_poses_.check(studio_, place.index);
  evaluate::AtlasView view;
  view.pose = place.index;
  view.camera = studio_.camera();
  view.map_from_optical = map_from_camera * linkFromOptical();
  view.depth = studio_.depth();
  for (const std::size_t c : conditions) {
    const std::string& name = options_.conditions[c].name;
    studio::Developed developed = studio_.photograph(lights_[c], {place.index, name, place.drive});
    view.lit.push_back({name, std::move(developed.picture), developed.ev100});
  }
  return view;
}

std::vector<evaluate::AtlasView> AtlasCamera::look(const AtlasPose& pose,
                                                   const std::vector<std::size_t>& conditions) {
  std::vector<evaluate::AtlasView> views = {viewFrom(pose.map_from_camera, {pose.number}, conditions)};
  if (!options_.atlas.has_query_drive) return views;
  views.push_back(viewFrom(pose.map_from_query_camera, {pose.number, "", "query"}, conditions));
  for (evaluate::AtlasView::Lit& lit : views.back().lit)
    lit.condition = evaluate::queryDriveOf(lit.condition);
  return views;
}

void AtlasCamera::writeLights(const std::string& file) const {
  if (std::filesystem::exists(file)) return;
  std::string text = "condition,date,time,sun_azimuth_deg,sun_elevation_deg,illuminance_lx\n";
  for (const std::string& line : lines_) text += line;
  image::writeFileAtomically(file, text);
}

std::size_t posesMissing(const AtlasRunOptions& options, const ObserveUnit& unit) {
  std::size_t missing = unit.end_pose - unit.first_pose;
  if (!std::filesystem::exists(unit.growing())) return missing;
  const UnitLock lock(unit.growing());
  const ObservationFile file(unit.growing());
  const WholePictures whole = wholeIn(options, file);
  for (std::size_t p = unit.first_pose; p < unit.end_pose; ++p) {
    if (lightsMissing(options, unit, options.poses[p], whole).empty()) --missing;
  }
  return missing;
}

void observeUnit(const AtlasRunOptions& options, const ObserveUnit& unit, AtlasCamera* camera,
                 const PoseDone& pose_done) {
  const UnitLock lock(unit.growing());
  {
    const evaluate::AtlasObserver observer(options.atlas);
    ObservationFile file(unit.growing());
    const WholePictures whole = wholeIn(options, file);
    for (std::size_t p = unit.first_pose; p < unit.end_pose; ++p) {
      const std::vector<std::size_t> lights = lightsMissing(options, unit, options.poses[p], whole);
      if (lights.empty()) continue;
      for (evaluate::AtlasView& view : camera->look(options.poses[p], lights))
        observer.observe(std::move(view), &file);
      pose_done();
    }
  }
  image::moveIntoPlace(unit.growing(), unit.file);
}

}  // namespace sunlit::tools
