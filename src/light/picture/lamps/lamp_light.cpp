#include "light/picture/lamps/lamp_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "light/geometry/ray_list.h"
#include "light/geometry/ray_start.h"
#include "light/patches/angles.h"
#include "light/shading/shading.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr int kPoints = 16, kFew = 4, kPeriod = 4;
/// Of the light that may reach a surface: a lamp that gives less is looked at with kFew rays instead of
/// kPoints, whose scatter in a penumbra is a quarter of its light; and one that gives less than that by the
/// mean of the pixels around.
constexpr float kLookedAtByAll = 0.1f, kLookedAtByFew = 0.02f;
/// The same of light that a surface passes on.
constexpr float kBouncedByFew = 0.2f;
/// How far a pixel looks for others that find it otherwise, and for those of which it takes the mean, px.
constexpr int kReach = 2, kMeanReach = 4;

/// Points that fill the unit disc evenly (a Fibonacci spiral), those at the rim first: they tell best whether
/// an edge crosses the disc. Turned differently for each of 4 × 4 pixels, the same in all such blocks.
using PointsOfPixel = std::array<Eigen::Vector2f, kPoints>;

const PointsOfPixel& pointsOf(int x, int y) {
  static const std::array<PointsOfPixel, kPeriod* kPeriod> all = [] {
    std::array<PointsOfPixel, kPeriod * kPeriod> made;
    for (std::size_t pixel = 0; pixel < made.size(); ++pixel) {
      // Neighbours are turned by far apart shares of the angle between two points of a quarter's ring.
      const double turned = 2.0 * kPi * static_cast<double>(pixel * 5 % made.size()) / 16.0;
      for (int i = 0; i < kPoints; ++i) {
        const int point = kPoints - 1 - i;
        const double radius = std::sqrt((point + 0.5) / kPoints), turn = kGoldenAngle * point + turned;
        made[pixel][static_cast<std::size_t>(i)] =
            Eigen::Vector2d(radius * std::cos(turn), radius * std::sin(turn)).cast<float>();
      }
    }
    return made;
  }();
  return all[static_cast<std::size_t>(y % kPeriod * kPeriod + x % kPeriod)];
}

/// A penumbra is wide where so many times more of the pixels around lie in it than beside it.
constexpr int kMixed = 3;
/// And as even, by rays, as chance and a slope make it; in a narrow one the mean would be that of a bend.
constexpr int kEven = 6, kEvenOfFew = 3;

/// Whether two surfaces lie about in one plane.
bool isOneSurface(const Surface& a, const Surface& b) {
  constexpr float kAlike = 0.98f, kOff = 0.1f;
  const Eigen::Vector3f way = b.position - a.position;
  return a.shading_normal.dot(b.shading_normal) > kAlike &&
         std::abs(a.geometric_normal.dot(way)) <= kOff * way.norm() + a.clearance_m;
}

/// From a surface to a point of a lamp that lies `aside` of its middle. Of a flat one, or a tube, that the
/// surface's plane cuts only what is before that counts: points behind it are turned over to the other side.
Eigen::Vector3f wayTo(const LampBeam& beam, const Surface& surface, const Eigen::Vector3f& middle,
                      const Eigen::Vector3f& aside) {
  const auto isBefore = [&](const Eigen::Vector3f& way) { return surface.geometric_normal.dot(way) > 0.0f; };
  const Eigen::Vector3f way = middle + aside, other = middle + beam.turnedOver(aside);
  return (beam.isFlat() || beam.isTube()) && !isBefore(way) && isBefore(other) ? other : way;
}

Eigen::AlignedBox3f boxOf(const Tile& tile) {
  Eigen::AlignedBox3f box;
  for (const Surface& surface : tile.surfaces) box.extend(surface.position);
  return box;
}

/// What rays of one lamp met in a tile, by pixel.
class Met {
 public:
  /// Of a row or column of the tile within `reach` of i.
  static int first(int i, int reach) { return std::max(i - reach, 0); }
  static int last(int i, int reach) { return std::min(i + reach, Surfaces::kTileSize - 1); }
  struct Count {
    int lit = 0, cast = 0;
    Count operator+(const Count& o) const { return {lit + o.lit, cast + o.cast}; }
    Count operator-(const Count& o) const { return {lit - o.lit, cast - o.cast}; }
  };
  void note(int x, int y, const Count& found) {
    Count& count = at_[index(y)][index(x)];
    count.lit += found.lit;
    count.cast += found.cast;
    if (found.lit > 0) lit_[index(y)] |= 1u << x;
    if (found.lit < found.cast) dark_[index(y)] |= 1u << x;
  }
  /// To be called when all is noted, before what follows.
  void finish() {
    lit_ = within(lit_);
    dark_ = within(dark_);
    for (std::size_t y = 0; y < Surfaces::kTileSize; ++y)
      for (std::size_t x = 0; x < Surfaces::kTileSize; ++x)
        before_[y + 1][x + 1] = at_[y][x] + before_[y][x + 1] + before_[y + 1][x] - before_[y][x];
  }
  /// Sum of what is within kMeanReach.
  Count around(int x, int y) const {
    const std::size_t left = index(first(x, kMeanReach)), right = index(last(x, kMeanReach)) + 1;
    const std::size_t top = index(first(y, kMeanReach)), bottom = index(last(y, kMeanReach)) + 1;
    return before_[bottom][right] - before_[top][right] - before_[bottom][left] + before_[top][left];
  }
  struct Kinds {
    bool lit, dark;
  };
  /// What is within kReach.
  Kinds near(int x, int y) const {
    return {(lit_[index(y)] >> x & 1u) != 0, (dark_[index(y)] >> x & 1u) != 0};
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::array<std::array<Count, Surfaces::kTileSize>, Surfaces::kTileSize> at_ = {};
  /// Sums of all above and to the left of a pixel.
  std::array<std::array<Count, Surfaces::kTileSize + 1>, Surfaces::kTileSize + 1> before_ = {};
  using Marks = std::array<unsigned, Surfaces::kTileSize>;  ///< of each row, a bit a column
  static Marks within(const Marks& marks) {
    Marks wide, all = {};
    for (std::size_t y = 0; y < marks.size(); ++y) {
      wide[y] = marks[y];
      for (int by = 1; by <= kReach; ++by) wide[y] |= marks[y] << by | marks[y] >> by;
    }
    for (int y = 0; y < Surfaces::kTileSize; ++y)
      for (int i = first(y, kReach); i <= last(y, kReach); ++i) all[index(y)] |= wide[index(i)];
    return all;
  }
  Marks lit_ = {}, dark_ = {};
};

}  // namespace

LampLight::LampLight(std::vector<LampBeam> beams, const Picture& picture)
    : beams_(std::move(beams)), picture_(picture), glass_(picture.visibility) {}

/// Without those, weakest first, whose sum is at most half of kLeftOut everywhere in the tile.
std::vector<std::uint32_t> LampLight::lampsOf(const Tile& tile, const std::vector<float>& other_lx) const {
  const Eigen::AlignedBox3f box = boxOf(tile);
  std::vector<std::pair<float, std::uint32_t>> at_most;
  float certain = *std::min_element(other_lx.begin(), other_lx.end());
  for (std::uint32_t i = 0; i < beams_.size(); ++i) {
    const LampBeam::Bounds bounds = beams_[i].within(box);
    certain += bounds.low;
    if (bounds.high > 0.0f) at_most.emplace_back(bounds.high, i);
  }
  std::sort(at_most.begin(), at_most.end());
  std::vector<std::uint32_t> chosen;
  float left_out = 0.0f;
  for (const auto& [high, lamp] : at_most) {
    left_out += high;
    if (left_out > 0.5f * kLeftOut * certain) chosen.push_back(lamp);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<LampLight::Place> LampLight::placesOf(const Tile& tile) const {
  const auto width = static_cast<std::uint32_t>(picture_.surfaces.width);
  const auto all_samples = static_cast<std::uint32_t>(picture_.surfaces.samples_per_pixel);
  std::vector<Place> places;
  places.reserve(tile.surfaces.size());
  for (const Surface& surface : tile.surfaces)
    places.push_back({static_cast<std::uint8_t>(surface.pixel % width % Surfaces::kTileSize),
                      static_cast<std::uint8_t>(surface.pixel / width % Surfaces::kTileSize),
                      surface.samples == all_samples});
  return places;
}

void LampLight::cast(const LampBeam& beam, const Tile& tile, const std::vector<Target*>& targets) const {
  thread_local RayList rays;
  thread_local std::vector<std::uint8_t> blocked;
  rays.clear();
  rays.reserve(targets.size() * kPoints);
  for (std::uint32_t k = 0; k < targets.size(); ++k) {
    Target& target = *targets[k];
    const Surface& surface = tile.surfaces[target.surface];
    const PointsOfPixel& points = pointsOf(target.at.x, target.at.y);
    // Probes lie a block apart, where all points are turned alike: of a wide ball they look for other points.
    const int first =
        beam.isBounced() ? target.at.y / kPeriod * (kPoints / kPeriod) + target.at.x / kPeriod : 0;
    const int up_to = target.cast == 0 ? 1 : (target.closeness == Closeness::kAll ? kPoints : kFew);
    std::uint32_t sample = (target.cast + target.at.x + target.at.y) % surface.samples;
    for (; target.cast < up_to; ++target.cast) {
      const std::uint32_t at = surface.first_sample + sample;
      if (++sample == surface.samples) sample = 0;
      const Eigen::Vector3f middle = beam.ball() - rayStart(tile, at);
      const float distance_m = middle.norm();
      // What is part of the lamp hides nothing.
      if (distance_m <= beam.spared_m() + surface.clearance_m) {
        ++target.lit;
        continue;
      }
      const float per_m = 1.0f / distance_m;
      const Eigen::Vector3f aside =
          beam.aside(middle * per_m, points[static_cast<std::size_t>((target.cast + first) % kPoints)]);
      const float reach = 1.0f - (beam.spared_m() + surface.clearance_m) * per_m;
      const Eigen::Vector3f way = wayTo(beam, surface, middle, aside);
      rays.add(k, rayStart(tile, at, surface, way), reach * way);
    }
  }
  blocked.resize(rays.size());
  picture_.visibility.occludedWithin(rays.rays(), blocked.data(), Visibility::Blends::kLetPass);
  for (std::size_t i = 0; i < rays.size(); ++i) targets[rays.number()[i]]->lit += 1 - blocked[i];
}

void LampLight::findShadows(std::uint32_t lamp, const Tile& tile, std::vector<Target>* targets) const {
  // Other pixels for other lamps, so that what they do not see does not fall together.
  const int aside = static_cast<int>(lamp * 5 % (kPeriod * kPeriod));
  const auto probes = [&](const Target& target) {
    const int x = target.at.x + aside % kPeriod, y = target.at.y + aside / kPeriod;
    switch (target.closeness) {
      case Closeness::kAll:
        return true;
      case Closeness::kFew:
        return !target.at.fills || (x + y) % 2 == 0;
      case Closeness::kMean:
        return x % kPeriod == 0 && y % kPeriod == 0;
    }
    return true;
  };
  const LampBeam& beam = beams_[lamp];
  std::vector<Target*> asked;
  asked.reserve(targets->size());
  for (Target& target : *targets)
    if (probes(target)) asked.push_back(&target);
  cast(beam, tile, asked);
  Met met;
  for (const Target* target : asked) met.note(target->at.x, target->at.y, {target->lit, target->cast});
  met.finish();
  asked.clear();
  std::vector<Target*> alone;
  for (Target& target : *targets) {
    if (target.closeness == Closeness::kMean) {
      const Met::Count found = met.around(target.at.x, target.at.y);
      if (found.cast == 0)
        alone.push_back(&target);
      else
        target.seen = static_cast<float>(found.lit) / static_cast<float>(found.cast);
      continue;
    }
    const Met::Kinds found = met.near(target.at.x, target.at.y);
    if (found.lit != found.dark) {
      target.seen = found.lit ? 1.0f : 0.0f;
      continue;
    }
    if (target.cast == 0) alone.push_back(&target);
    if (found.lit) asked.push_back(&target);
  }
  cast(beam, tile, alone);
  cast(beam, tile, asked);
  for (const std::vector<Target*>* list : {&alone, &asked})
    for (Target* target : *list)
      target->seen = static_cast<float>(target->lit) / static_cast<float>(target->cast);
  smoothPenumbrae(tile, asked);
}

/// In wide penumbrae rays of a pixel tell a share about, and its neighbours, whose points are turned
/// otherwise, the rest of it.
void LampLight::smoothPenumbrae(const Tile& tile, const std::vector<Target*>& targets) {
  constexpr int kSide = Surfaces::kTileSize;
  std::array<const Target*, static_cast<std::size_t>(kSide * kSide)> at{};
  const auto isSure = [](const Target& target) { return target.at.fills && target.cast >= kFew; };
  for (const Target* target : targets)
    if (isSure(*target)) at[static_cast<std::size_t>(target->at.y * kSide + target->at.x)] = target;
  for (Target* target : targets) {
    const auto isMixed = [](const Target& one) { return one.lit > 0 && one.lit < one.cast; };
    if (!isSure(*target) || !isMixed(*target)) continue;
    const Surface& surface = tile.surfaces[target->surface];
    int lit = 0, cast = 0, mixed = 0, others = 0, most = 0, least = kPoints;
    for (int y = Met::first(target->at.y, kReach); y <= Met::last(target->at.y, kReach); ++y) {
      for (int x = Met::first(target->at.x, kReach); x <= Met::last(target->at.x, kReach); ++x) {
        const Target* const other = at[static_cast<std::size_t>(y * kSide + x)];
        if (!other || other->cast != target->cast) continue;
        if (!isOneSurface(surface, tile.surfaces[other->surface])) continue;
        lit += other->lit;
        cast += other->cast;
        (isMixed(*other) ? mixed : others) += 1;
        most = std::max<int>(most, other->lit);
        least = std::min<int>(least, other->lit);
      }
    }
    const bool even = most - least <= (target->cast == kPoints ? kEven : kEvenOfFew);
    if (even && mixed > kMixed * others) target->seen = static_cast<float>(lit) / static_cast<float>(cast);
  }
}

LampLight::Closeness LampLight::closenessOf(const LampBeam& beam, float share) {
  // What surfaces pass on has no sharp shadows.
  if (beam.isBounced()) return share >= kBouncedByFew ? Closeness::kFew : Closeness::kMean;
  return share >= kLookedAtByAll   ? Closeness::kAll
         : share >= kLookedAtByFew ? Closeness::kFew
                                   : Closeness::kMean;
}

std::vector<LampLight::Target> LampLight::targetsOf(const LitRows::Reflected& reflected, const LitRows& rows,
                                                    const std::vector<Place>& places) {
  const std::size_t stride = rows.stride();
  std::vector<Target> targets;
  targets.reserve(LitRows::kBlock * reflected.blocks.size());
  for (const std::uint32_t begin : reflected.blocks) {
    const std::size_t end = std::min(begin + LitRows::kBlock, rows.count());
    for (std::uint32_t i = begin; i < end; ++i) {
      const float* const value = reflected.values.data() + i;
      const float brightest = value[3 * stride];
      if (brightest > 0.0f)
        targets.push_back({i, {value[0], value[stride], value[2 * stride]}, brightest, places[i]});
    }
  }
  return targets;
}

std::vector<LampLight::OfLamp> LampLight::targetsOf(const Tile& tile,
                                                    const std::vector<float>& other_lx) const {
  const std::vector<std::uint32_t> lamps = lampsOf(tile, other_lx);
  if (lamps.empty()) return {};
  thread_local LitRows rows;
  thread_local LitRows::Reflected reflected;
  thread_local std::vector<float> shares, least_lx;
  rows.set(tile, picture_.scene, picture_.by_rays);
  const std::vector<Place> places = placesOf(tile);
  const std::size_t stride = rows.stride();
  shares.resize(lamps.size() * stride);
  least_lx.assign(other_lx.begin(), other_lx.end());
  least_lx.resize(stride, 0.0f);
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    const LampBeam& beam = beams_[lamps[k]];
    float* const of_lamp = shares.data() + k * stride;
    beam.shares(rows.positions(), of_lamp);
    for (std::size_t i = 0; i < stride; ++i) least_lx[i] += of_lamp[i] * beam.brightest();
  }
  // The other half of kLeftOut: what each of the lamps may fall short of at each surface.
  for (float& lx : least_lx) lx *= 0.5f * kLeftOut / static_cast<float>(lamps.size());
  std::vector<OfLamp> all;
  all.reserve(lamps.size());
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    rows.reflect(beams_[lamps[k]], {shares.data() + k * stride, least_lx.data()}, &reflected);
    if (reflected.blocks.empty()) continue;
    OfLamp of{lamps[k], 0.0f, targetsOf(reflected, rows, places)};
    for (const Target& target : of.targets) of.sum += target.brightest;
    if (!of.targets.empty()) all.push_back(std::move(of));
  }
  std::sort(all.begin(), all.end(), [](const OfLamp& a, const OfLamp& b) {
    return a.sum != b.sum ? a.sum > b.sum : a.lamp < b.lamp;
  });
  return all;
}

Eigen::Array3f LampLight::throughVeils(const LampBeam& beam, const Tile& tile, const Surface& surface) const {
  Eigen::Array3f through = Eigen::Array3f::Zero();
  const std::uint32_t rays = glass_.raysOf(surface.samples);
  for (std::uint32_t k = 0; k < rays; ++k) {
    const std::size_t at = surface.first_sample + k;
    const Eigen::Vector3f origin = rayStart(tile, at, surface, beam.ball() - rayStart(tile, at));
    const Eigen::Vector3f way = beam.ball() - origin;
    const Visibility::Sight sight{origin, way, 0.0f, 1.0f - beam.spared_m() / std::max(way.norm(), 1e-6f)};
    if (!(sight.far > 0.0f)) {
      through += 1.0f;
    } else {
      through += beam.castsShadows() ? glass_.throughVeils(sight) : glass_.through(sight);
    }
  }
  return through / static_cast<float>(rays);
}

void LampLight::addTo(const Tile& tile, const std::vector<float>& other_lx,
                      std::vector<Eigen::Array3f>* luminances) const {
  if (beams_.empty() || tile.surfaces.empty()) return;
  std::vector<OfLamp> all = targetsOf(tile, other_lx);
  if (all.empty()) return;
  thread_local std::vector<Eigen::Array3f> by_lamps;
  by_lamps.assign(tile.surfaces.size(), Eigen::Array3f::Zero());
  // What may reach each surface: what did, and what lamps not yet looked at give where nothing is in the way.
  std::vector<float> possible(tile.surfaces.size(), 0.0f);
  for (const OfLamp& of : all)
    for (const Target& target : of.targets) possible[target.surface] += target.brightest;
  for (OfLamp& of : all) {
    for (Target& target : of.targets)
      target.closeness = closenessOf(beams_[of.lamp], target.brightest / possible[target.surface]);
    if (beams_[of.lamp].castsShadows()) findShadows(of.lamp, tile, &of.targets);
    for (const Target& target : of.targets) {
      Eigen::Array3f arrives = target.seen * target.unhidden;
      if (glass_.anyVeils() && target.seen > 0.0f)
        arrives *= throughVeils(beams_[of.lamp], tile, tile.surfaces[target.surface]);
      by_lamps[target.surface] += arrives;
      // Not less than what is there: rounding must not make it nothing.
      possible[target.surface] = std::max(possible[target.surface] - (1.0f - target.seen) * target.brightest,
                                          by_lamps[target.surface].maxCoeff());
    }
  }
  for (std::size_t i = 0; i < by_lamps.size(); ++i) (*luminances)[i] += by_lamps[i];
}

}  // namespace sunlit::light
