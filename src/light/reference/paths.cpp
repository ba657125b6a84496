#include "light/reference/paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sunlit/light/lamps.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Random numbers of one bounce: three for the direction, two for the place on the disc, two for the place in
/// the sky, one for its survival.
enum Dimension : std::size_t { kDirection = 0, kOnDisc = 3, kInSky = 5, kSurvival = 7, kPerBounce = 8 };
constexpr int kSureBounces = 3;
/// Random numbers of glass on the way lie beyond those of all bounces.
constexpr std::uint64_t kGlass = std::uint64_t{1} << 32;
/// Likewise those of points that shine, three a bounce.
constexpr std::uint64_t kShining = std::uint64_t{1} << 33;

void appendDisc(const sky::DiscLight& light, std::size_t day, std::vector<Disc>* discs) {
  if (light.illuminance.value.maxCoeff() > 0.0f) discs->push_back({day, DiscArea(light), light});
}

/// With which density addLamp() chooses `towards`, 1/sr, of a lamp that shows a disc in the distance of
/// `middle`.
float densityOnLamp(const LampBeam& lamp, const Eigen::Vector3f& middle, const Eigen::Vector3f& towards) {
  const float cosine = middle.dot(towards) / middle.norm(), reach_m = middle.norm() / cosine;
  return reach_m * reach_m / (kPiFloat * lamp.radius_m() * lamp.radius_m() * cosine);
}

}  // namespace

PathScene::PathScene(const World& world_to_trace, const std::vector<sky::Daylight>& days_to_trace,
                     const ReferenceOptions& options_to_use, int samples_in_pixel)
    : world(world_to_trace),
      days(days_to_trace),
      options(options_to_use),
      samples_per_pixel(samples_in_pixel),
      vertices(*world_to_trace.geometry),
      glass(*world_to_trace.visibility),
      emitters(*world_to_trace.geometry),
      lamps(options.lamps.begin(), options.lamps.end()),
      floors(facetsOfFloors(*world_to_trace.geometry)) {
  for (std::size_t day = 0; day < days.size(); ++day) {
    appendDisc(days[day].sun(), day, &discs);
    appendDisc(days[day].moon(), day, &discs);
    skies.emplace_back(days[day]);
  }
}

void Paths::Bundle::clear() {
  for (auto* list : {&ox, &oy, &oz, &dx, &dy, &dz}) list->clear();
  path.clear();
}

void Paths::Bundle::add(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                        std::size_t of_path) {
  ox.push_back(origin.x());
  oy.push_back(origin.y());
  oz.push_back(origin.z());
  dx.push_back(direction.x());
  dy.push_back(direction.y());
  dz.push_back(direction.z());
  path.push_back(static_cast<std::uint32_t>(of_path));
}

Rays Paths::Bundle::rays() const {
  return {ox.data(), oy.data(), oz.data(), dx.data(), dy.data(), dz.data(), path.size()};
}

void Paths::start(const Tile& tile, const Surface& surface) {
  const std::uint64_t place = scrambled((std::uint64_t{scene_.options.seed} << 32) ^ surface.pixel) ^
                              scrambled(~std::uint64_t{surface.first_sample});
  // Rounded up, so that each of the surface's samples counts as much as the next.
  const auto wanted = static_cast<std::uint32_t>(scene_.options.samples_per_pixel / 2);
  const auto in_pixel = static_cast<std::uint32_t>(scene_.samples_per_pixel);
  const std::uint32_t count = (wanted + in_pixel - 1) / in_pixel * surface.samples;
  even_.clear();
  paths_.clear();
  for (int half = 0; half < 2; ++half) {
    const std::uint64_t key = scrambled(place + static_cast<std::uint64_t>(half));
    even_.emplace_back(key);
    for (std::uint32_t i = 0; i < count; ++i) {
      paths_.push_back({seenVertex(tile, surface, *scene_.world.geometry->scene, i % surface.samples),
                        Eigen::Array3f::Ones(), scrambled(key + 1 + i), 0.0f, i, half});
    }
  }
  for (Radiances& sums : sums_) sums.assign(scene_.days.size(), Eigen::Array3f::Zero());
}

std::array<Radiances, 2> Paths::luminance(const Tile& tile, const Surface& surface) {
  start(tile, surface);
  const auto per_half = static_cast<float>(paths_.size() / 2);
  for (int bounce = 0; !paths_.empty(); ++bounce) {
    if (bounce == 0) addEmission();
    addShining(bounce);
    for (const Disc& disc : scene_.discs) {
      addDisc(disc, bounce);
      addDiscInFloors(disc, bounce);
    }
    for (const LampBeam& lamp : scene_.lamps) addLamp(lamp, bounce);
    for (std::size_t day = 0; day < scene_.days.size(); ++day) addSkyOf(day, bounce);
    scatterAll(bounce);
    for (const LampBeam& lamp : scene_.lamps) addLampMet(lamp);
    advance(bounce);
  }
  for (Radiances& sums : sums_) {
    for (Eigen::Array3f& sum : sums) sum /= per_half;
  }
  return sums_;
}

float Paths::random(const Path& path, int bounce, std::size_t dimension) const {
  if (bounce == 0 && dimension < EvenPoints::kDimensions) {
    return even_[static_cast<std::size_t>(path.half)].at(path.index, dimension);
  }
  return uniform(path.key, static_cast<std::uint64_t>(bounce) * kPerBounce + dimension);
}

void Paths::addEmission() {
  for (const Path& path : paths_) {
    const Eigen::Array3f& emission = path.vertex.emission;
    if (!(emission.maxCoeff() > 0.0f) || !glows(*path.vertex.material, scene_.options.lamps)) continue;
    for (Eigen::Array3f& sum : sums_[static_cast<std::size_t>(path.half)]) sum += path.throughput * emission;
  }
}

// Weighed as the sky's directions are, see addSkyOf().
void Paths::addShining(int bounce) {
  if (!scene_.emitters.any()) return;
  bundle_.clear();
  weights_.clear();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Vertex& vertex = paths_[i].vertex;
    const std::uint64_t number = kShining + 3 * static_cast<std::uint64_t>(bounce);
    const std::uint64_t key = paths_[i].key;
    const Emitters::Point point =
        scene_.emitters.sample({uniform(key, number), uniform(key, number + 1), uniform(key, number + 2)});
    const Eigen::Vector3f middle = point.position - vertex.front;
    const float distance_m = middle.norm();
    if (!(distance_m > 0.0f)) continue;
    const Eigen::Vector3f towards = middle / distance_m;
    if (!vertex.faces(towards)) continue;
    const Eigen::Array3f emission = scene_.vertices.at(point.hit, towards).emission;
    const Eigen::Array3f weight = directReflectance(vertex.reflection, towards, 0.0f) * emission;
    if (!(weight.maxCoeff() > 0.0f)) continue;
    const float density =
        scene_.emitters.density(point.hit, towards, distance_m) + scatterDensity(vertex.reflection, towards);
    const Eigen::Vector3f way = point.position - vertex.origin(towards);
    const float clear = 2.0f * rayClearance_m(point.position, 0.0f) / way.norm();
    bundle_.add(vertex.origin(towards), std::max(1.0f - clear, 1e-6f) * way, i);
    weights_.push_back(paths_[i].throughput * weight / density);
  }
  castAndAddOnAllDays(true);
}

void Paths::addShineMet(std::size_t i, const Path& path) {
  const Vertex met = scene_.vertices.at(hits_[i], scattered_[i].towards);
  if (!(met.emission.maxCoeff() > 0.0f) || !met.material->lamp_group.empty()) return;
  const float distance_m = (met.front - path.vertex.front).norm();
  const float density =
      scattered_[i].density + scene_.emitters.density(hits_[i], scattered_[i].towards, distance_m);
  const Eigen::Array3f weight = path.throughput * scattered_[i].reflectance / density;
  for (Eigen::Array3f& sum : sums_[static_cast<std::size_t>(path.half)]) sum += weight * met.emission;
}

void Paths::addDisc(const Disc& disc, int bounce) {
  bundle_.clear();
  weights_.clear();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Vertex& vertex = paths_[i].vertex;
    const Eigen::Vector3f towards =
        disc.area.point(random(paths_[i], bounce, kOnDisc), random(paths_[i], bounce, kOnDisc + 1));
    if (!vertex.faces(towards)) continue;
    const Eigen::Array3f weight = directReflectance(vertex.reflection, towards, 0.0f);
    if (!(weight.maxCoeff() > 0.0f)) continue;
    const float by_chance = paths_[i].density, by_floors = densityInFloors(paths_[i], towards);
    const float share = by_floors > 0.0f ? by_chance / (by_chance + by_floors) : 1.0f;
    bundle_.add(vertex.origin(towards), towards, i);
    weights_.push_back(share * paths_[i].throughput * weight * disc.light.illuminance.value);
  }
  throughCloud(disc);
  castAndAdd(disc.day);
}

void Paths::throughCloud(const Disc& disc) {
  const sky::Daylight& day = scene_.days[disc.day];
  if (!day.hasBrokenCloud()) return;
  for (std::size_t k = 0; k < weights_.size(); ++k)
    weights_[k] *= day.throughCloud(disc.light, bundle_.origin(k));
}

// Weighed as the sky's directions are, see addSkyOf().
void Paths::addLamp(const LampBeam& lamp, int bounce) {
  bundle_.clear();
  weights_.clear();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Vertex& vertex = paths_[i].vertex;
    const Eigen::Vector3f middle = lamp.position() - vertex.front;
    const float distance_m = middle.norm();
    if (!(distance_m > lamp.radius_m())) continue;
    const float radius = lamp.radius_m() * std::sqrt(random(paths_[i], bounce, kOnDisc));
    const float angle = static_cast<float>(2.0 * kPi) * random(paths_[i], bounce, kOnDisc + 1);
    const Eigen::Vector3f way =
        middle + LampBeam::across(middle / distance_m) *
                     Eigen::Vector2f(radius * std::cos(angle), radius * std::sin(angle));
    const Eigen::Vector3f towards = way.normalized();
    if (!vertex.faces(towards)) continue;
    Eigen::Array3f weight = directReflectance(vertex.reflection, towards, 0.0f) * lamp.at(vertex.front);
    if (!(weight.maxCoeff() > 0.0f)) continue;
    if (lamp.radius_m() > 0.0f) {
      const float density = densityOnLamp(lamp, middle, towards);
      weight *= density / (density + scatterDensity(vertex.reflection, towards));
    }
    addRayToLamp(lamp, way, i);
    weights_.push_back(paths_[i].throughput * weight);
  }
  castAndAddOnAllDays(lamp.castsShadows());
}

void Paths::addRayToLamp(const LampBeam& lamp, const Eigen::Vector3f& way, std::size_t of_path) {
  const Vertex& vertex = paths_[of_path].vertex;
  // What is part of the lamp hides nothing.
  const float ball_m = lamp.spared_m() + rayClearance_m(vertex.front, 0.0f);
  bundle_.add(vertex.origin(way.normalized()),
              std::max(1.0f - ball_m / (lamp.position() - vertex.front).norm(), 1e-6f) * way, of_path);
}

void Paths::addLampMet(const LampBeam& lamp) {
  if (!(lamp.radius_m() > 0.0f)) return;
  bundle_.clear();
  weights_.clear();
  for (std::size_t k = 0; k < scattered_.size(); ++k) {
    const Path& path = paths_[of_path_[k]];
    const Eigen::Vector3f& towards = scattered_[k].towards;
    const Eigen::Vector3f middle = lamp.position() - path.vertex.front;
    const float along = middle.dot(towards);
    if (!(along > 0.0f && middle.norm() > lamp.radius_m())) continue;
    const Eigen::Vector3f way = middle.squaredNorm() / along * towards;
    if ((way - middle).squaredNorm() > lamp.radius_m() * lamp.radius_m()) continue;
    const float density = densityOnLamp(lamp, middle, towards);
    addRayToLamp(lamp, way, of_path_[k]);
    weights_.push_back(path.throughput * scattered_[k].reflectance * lamp.at(path.vertex.front) *
                       (density / (density + scattered_[k].density)));
  }
  if (!weights_.empty()) castAndAddOnAllDays(lamp.castsShadows());
}

void Paths::castAndAddOnAllDays(bool shadows) {
  passGlass(1.0f);
  blocked_.assign(bundle_.path.size(), 0);
  if (shadows) scene_.world.visibility->occludedWithin(bundle_.rays(), blocked_.data());
  for (std::size_t i = 0; i < blocked_.size(); ++i) {
    if (blocked_[i]) continue;
    for (Eigen::Array3f& sum : sums_[static_cast<std::size_t>(paths_[bundle_.path[i]].half)])
      sum += weights_[i];
  }
}

void Paths::passGlass(float reach) {
  if (!scene_.glass.any()) return;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] *= scene_.glass.through({bundle_.origin(i), bundle_.direction(i), 0.0f, reach});
}

void Paths::passGlassTo(std::size_t i, int bounce, Path* path) {
  if (!scene_.glass.any()) return;
  const bool misses = hits_[i].triangle == Hit::kMiss;
  const float reach = misses ? std::numeric_limits<float>::infinity() : hits_[i].distance;
  const Eigen::Vector3f direction = bundle_.direction(i);
  scene_.glass.sheets({bundle_.origin(i), direction, 0.0f, reach}, &sheets_);
  for (std::size_t sheet = 0; sheet < sheets_.size(); ++sheet) {
    const Eigen::Array3f through = straightThrough(scene_.glass.at(sheets_[sheet], direction).reflection);
    // Neither is left to chance where little of it is.
    const float odds = std::clamp(through.maxCoeff(), 0.1f, 0.9f);
    const auto number = kGlass + static_cast<std::uint64_t>(bounce) * Visibility::kMostVeils + sheet;
    if (uniform(path->key, number) >= odds) {
      path->throughput /= 1.0f - odds;
      hits_[i] = sheets_[sheet];
      return;
    }
    path->throughput *= through / odds;
  }
}

void Paths::castAndAdd(std::size_t day) {
  passGlass(std::numeric_limits<float>::infinity());
  blocked_.resize(bundle_.path.size());
  scene_.world.visibility->occluded(bundle_.rays(), blocked_.data());
  for (std::size_t i = 0; i < blocked_.size(); ++i) {
    if (blocked_[i]) continue;
    sums_[static_cast<std::size_t>(paths_[bundle_.path[i]].half)][day] += weights_[i];
  }
}

// Both ways of choosing a direction are weighed by the balance heuristic (Veach 1997, eq. 9.8): together they
// count a direction by the sum of their densities.
void Paths::addSkyOf(std::size_t day, int bounce) {
  bundle_.clear();
  weights_.clear();
  const SkySampler& sky = scene_.skies[day];
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Path& path = paths_[i];
    const Eigen::Vector3f towards =
        sky.sample(random(path, bounce, kInSky), random(path, bounce, kInSky + 1));
    if (!path.vertex.faces(towards)) continue;
    const Eigen::Array3f reflectance = directReflectance(path.vertex.reflection, towards, 0.0f);
    if (!(reflectance.maxCoeff() > 0.0f)) continue;
    const float density = sky.density(towards) + scatterDensity(path.vertex.reflection, towards);
    bundle_.add(path.vertex.origin(towards), towards, i);
    weights_.push_back(path.throughput * reflectance * scene_.days[day].skyLuminance(towards).value /
                       density);
  }
  castAndAdd(day);
}

void Paths::addSkyMet(const Path& path, const Scattered& scattered) {
  Radiances& sums = sums_[static_cast<std::size_t>(path.half)];
  for (std::size_t day = 0; day < sums.size(); ++day) {
    const float density = scattered.density + scene_.skies[day].density(scattered.towards);
    sums[day] += path.throughput * scattered.reflectance *
                 scene_.days[day].skyLuminance(scattered.towards).value / density;
  }
}

void Paths::scatterAll(int bounce) {
  of_path_.clear();
  scattered_.clear();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Path& path = paths_[i];
    const Scattered scattered = scatter(
        path.vertex.reflection, {random(path, bounce, kDirection), random(path, bounce, kDirection + 1),
                                 random(path, bounce, kDirection + 2)});
    if (!path.vertex.faces(scattered.towards) || !(scattered.density > 0.0f)) continue;
    if (!((path.throughput * scattered.reflectance).maxCoeff() > 0.0f)) continue;
    of_path_.push_back(i);
    scattered_.push_back(scattered);
  }
}

void Paths::advance(int bounce) {
  bundle_.clear();
  for (std::size_t k = 0; k < scattered_.size(); ++k) {
    const Eigen::Vector3f& towards = scattered_[k].towards;
    bundle_.add(paths_[of_path_[k]].vertex.origin(towards), towards, of_path_[k]);
  }
  hits_.resize(bundle_.path.size());
  scene_.world.visibility->closest(bundle_.rays(), hits_.data());
  next_.clear();
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    Path& path = paths_[bundle_.path[i]];
    passGlassTo(i, bounce, &path);
    if (hits_[i].triangle == Hit::kMiss) {
      addSkyMet(path, scattered_[i]);
      continue;
    }
    addShineMet(i, path);
    path.throughput *= scattered_[i].reflectance / scattered_[i].density;
    path.density = scattered_[i].density;
    if (bounce >= scene_.options.bounces || !survives(bounce, &path)) continue;
    path.vertex = scene_.vertices.at(hits_[i], scattered_[i].towards);
    next_.push_back(path);
  }
  paths_.swap(next_);
}

/// The odds follow what is left of the light; survivors make up for the dead.
bool Paths::survives(int bounce, Path* path) const {
  if (bounce < kSureBounces) return true;
  const float odds = std::clamp(path->throughput.maxCoeff(), 0.05f, 0.95f);
  if (random(*path, bounce, kSurvival) >= odds) return false;
  path->throughput /= odds;
  return true;
}

}  // namespace sunlit::light
