/// All paths of light that end in one surface of the picture, traced side by side.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "light/lamps/lamp_beam.h"
#include "light/patches/disc_area.h"
#include "light/reference/emitters.h"
#include "light/reference/sky_sampler.h"
#include "light/shading/ggx.h"
#include "light/shading/glass_sheets.h"
#include "light/shading/scatter.h"
#include "light/shading/vertex.h"
#include "sunlit/light/reference.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {

/// A sun or moon that shines.
struct Disc {
  std::size_t day;
  DiscArea area;
  sky::DiscLight light;
};

/// Of polished floors, by their mean roughness; none: there are none.
std::optional<Ggx<float>> facetsOfFloors(const Geometry& geometry);

/// What all pixels share.
struct PathScene {
  PathScene(const World& world_to_trace, const std::vector<sky::Daylight>& days_to_trace,
            const ReferenceOptions& options_to_use, int samples_in_pixel);

  const World& world;
  const std::vector<sky::Daylight>& days;
  ReferenceOptions options;
  int samples_per_pixel;  ///< Surfaces::samples_per_pixel
  SceneVertices vertices;
  GlassSheets glass;
  Emitters emitters;
  std::vector<Disc> discs;
  std::vector<LampBeam> lamps;
  std::vector<SkySampler> skies;     ///< one a day
  std::optional<Ggx<float>> floors;  ///< facetsOfFloors()
};

/// Of one half of the paths, one a day.
using Radiances = std::vector<Eigen::Array3f>;

class Paths {
 public:
  explicit Paths(const PathScene& scene) : scene_(scene) {}

  /// Mean luminance of `surface` by each half of its paths, without the air before it.
  std::array<Radiances, 2> luminance(const Tile& tile, const Surface& surface);

 private:
  struct Path {
    Vertex vertex;
    Eigen::Array3f throughput;
    std::uint64_t key;     ///< of its random numbers
    float density = 0.0f;  ///< with which `vertex` was chosen by the one before, 1/sr; 0: there was none
    std::uint32_t index;   ///< within its half
    int half;
  };
  /// Rays as arrays, and the path that each belongs to.
  struct Bundle {
    std::vector<float> ox, oy, oz, dx, dy, dz;
    std::vector<std::uint32_t> path;
    void clear();
    void add(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, std::size_t of_path);
    Rays rays() const;
    Eigen::Vector3f origin(std::size_t i) const { return {ox[i], oy[i], oz[i]}; }
    Eigen::Vector3f direction(std::size_t i) const { return {dx[i], dy[i], dz[i]}; }
  };

  void start(const Tile& tile, const Surface& surface);
  float random(const Path& path, int bounce, std::size_t dimension) const;
  /// What the surfaces of the picture give off themselves.
  void addEmission();
  /// Surfaces that shine, by points chosen for what they give.
  void addShining(int bounce);
  /// Surfaces that shine, where a ray chosen by the surface meets one, at hits_[i].
  void addShineMet(std::size_t i, const Path& path);
  /// On all days, of rays that end with their direction.
  void castAndAddOnAllDays(bool shadows);
  void addDisc(const Disc& disc, int bounce);
  /// Where each of the bundle's rays begins, gaps and clouds make more or less of the disc.
  void throughCloud(const Disc& disc);
  /// The same by way of polished floors: chance alone rarely meets the spot that mirrors it.
  void addDiscInFloors(const Disc& disc, int bounce);
  /// Has the bundle's rays go on from the polished floors that they meet, each to one of `points`; others
  /// end.
  void goOnFromFloors(const std::vector<Eigen::Vector3f>& points);
  /// With which density addDiscInFloors() would have chosen `path`'s last step, were `towards` the disc's
  /// point; 0: never.
  float densityInFloors(const Path& path, const Eigen::Vector3f& towards) const;
  /// One lamp on all days, by points of its disc.
  void addLamp(const LampBeam& lamp, int bounce);
  /// The same where a ray chosen by the surface meets it: smooth mirrors show a lamp to no others.
  void addLampMet(const LampBeam& lamp);
  /// To the bundle, to the end of `way` or as much before it as the lamp spares.
  void addRayToLamp(const LampBeam& lamp, const Eigen::Vector3f& way, std::size_t of_path);
  /// Sky, by directions chosen for its brightness.
  void addSkyOf(std::size_t day, int bounce);
  /// Sky, where a ray chosen by the surface meets it.
  void addSkyMet(const Path& path, const Scattered& scattered);
  void castAndAdd(std::size_t day);
  /// Takes from weights_ what glass on the way keeps back; rays reach so many times their length.
  void passGlass(float reach);
  /// The path of ray number `i` of the bundle passes the glass before hits_[i], or ends by chance at one of
  /// the sheets, which hits_[i] then is.
  void passGlassTo(std::size_t i, int bounce, Path* path);
  /// Has each path choose a direction by its surface.
  void scatterAll(int bounce);
  /// Along these to the next surfaces. Paths that reach the sky or die are gone afterwards.
  void advance(int bounce);
  bool survives(int bounce, Path* path) const;

  const PathScene& scene_;
  std::vector<Path> paths_, next_;
  std::vector<EvenPoints> even_;  ///< one a half
  std::array<Radiances, 2> sums_;
  Bundle bundle_;
  std::vector<std::uint8_t> blocked_;
  std::vector<Eigen::Array3f> weights_;  ///< what each ray of the bundle adds if nothing stops it
  std::vector<Scattered> scattered_;
  std::vector<std::size_t> of_path_;  ///< of each of them
  std::vector<Hit> hits_;
  std::vector<Hit> sheets_;
};

}  // namespace sunlit::light
