/// Sky light and bounced light, computed once per scene for every sky.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/light/geometry.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/visibility.h"
#include "sunlit/quantity/field.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

struct TransportOptions {
  int rays_per_patch = 3;
  int bounces = 3;
  std::optional<double> finest_m;  ///< none: see finestOf()
  int samples = 800000;            ///< large triangles get what others leave
};

inline std::vector<Field> fieldsOf(TransportOptions& options) {
  return {{"rays",
           &options.rays_per_patch,
           "",
           {1, 64},
           "from each sample to each of the 175 patches of the sky"},
          {"bounces", &options.bounces, "", {0, 8}, "of light from surface to surface"},
          {"finest",
           NumberOrWord{&options.finest_m, "auto"},
           "m",
           {0.02, 10},
           "between samples where light changes fastest; auto: 0.25, less in worlds below 16 m"},
          {"samples", &options.samples, "", {1000, 1e7}, "at most about so many"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const TransportOptions& options);

/// TransportOptions::finest_m of a scene, m: without one 0.25, and a 64th of the diagonal of scenes that are
/// smaller than 16 m, but 0.02 at least: on a table things stand as close as elsewhere on a street.
double finestOf(const TransportOptions& options, const Geometry& geometry);

/// How far a bake is: share done, 0 … 1, and seconds left by the time taken so far, NaN while too little is
/// done to tell; of the bake of another process, too, while it is waited for. Never called by two threads at
/// once. What it throws ends the bake or the wait, and comes out of it.
using BakeProgress = std::function<void(double share, double seconds_left)>;

/// Who is told of a bake.
struct BakeListener {
  BakeProgress progress;                        ///< may be empty
  std::function<void(const std::string&)> log;  ///< one line of what did not go as it should; may be empty
  std::function<void(const std::string&)> note = {};  ///< one line of what takes its time; may be empty
  /// Called again and again while another process makes the same bake; what it throws ends the wait, and
  /// comes out of it. May be empty.
  std::function<void()> check = {};
};

/// Where bakes are kept, and how much of the disk they may take.
struct BakeCache {
  static constexpr std::uintmax_t kUsualLimit_bytes = 2'000'000'000;
  /// Also from the folder alone.
  BakeCache(std::string folder_, std::uintmax_t limit_bytes_ = kUsualLimit_bytes)
      : folder(std::move(folder_)), limit_bytes(limit_bytes_) {}

  std::string folder;
  /// Beyond it those go that have not been used for longest, but none that a process uses now.
  std::uintmax_t limit_bytes;

  /// What the bakes in the folder take now; 0 where there is no such folder.
  std::uintmax_t usedBytes() const;
};

struct TransportData;

/// Daylight coefficients (Tregenza & Waters 1983) at samples of the scene's surfaces: how much light arrives
/// for each patch of the sky, directly and passed on by surfaces. Linear in the sky, so that another
/// one costs a product per sample; in rooms, streets and tunnels rays find what sun and moon shine on, too.
/// Immutable; may be read by many threads.
class Transport {
 public:
  /// Traces the scene, which takes seconds to minutes. Parallel; the same bits for any number of threads.
  /// Throws std::invalid_argument for options out of range, std::runtime_error if the ray library fails or
  /// the scene takes more than 2^24 samples.
  static std::shared_ptr<const Transport> bake(std::shared_ptr<const Geometry> geometry,
                                               const TransportOptions& options,
                                               const BakeProgress& progress = nullptr);
  /// As bake(), but reads the result from the folder of `cache` where an equal bake has left it, and leaves
  /// it there. A file that is broken or of another scene is named by one line to the listener's log and
  /// replaced; if the folder can't be written, that is logged too. Of several processes that want the same
  /// bake, one computes it.
  static std::shared_ptr<const Transport> cached(std::shared_ptr<const Geometry> geometry,
                                                 const TransportOptions& options, const BakeCache& cache,
                                                 const BakeListener& listener = {});

  /// `data` is a bake with `options`.
  Transport(const TransportOptions& options, std::unique_ptr<const TransportData> data);
  ~Transport();

  /// The light of each node. Of lamps that stand in the scene, and of compactSources(), what surfaces pass
  /// on: a share for each set of them that was baked together, as illumination(world, …) finds them.
  /// `visibility`, of the scene, finds where sun and moon shine into rooms, streets and tunnels; without it
  /// their light is spread over the patches of the sky around them before it is passed on.
  std::vector<NodeLight> relight(const sky::Daylight& day, const std::vector<float>& lamp_shares = {},
                                 const Visibility* visibility = nullptr) const;
  /// The same with all else that `day` means at the nodes: Illumination but for its bodies and lamps.
  Illumination illumination(const sky::Daylight& day, const std::vector<float>& lamp_shares = {},
                            const Visibility* visibility = nullptr) const;

  /// Illumination::node_open.
  const std::shared_ptr<const std::vector<float>>& nodeOpen() const { return node_open_; }

  /// Where relight() leaves out what polished floors throw, if it knows where discs shine; null: nowhere.
  const std::shared_ptr<const GlintNodes>& glintNodes() const { return glint_nodes_; }

  /// Illumination::compact_sources.
  const std::shared_ptr<const std::vector<CompactSource>>& compactSources() const { return compact_sources_; }

  /// All that the bake keeps, for those who light by it.
  const TransportData& data() const { return *data_; }
  const TransportOptions& options() const { return options_; }
  std::size_t sampleCount() const;
  std::size_t nodeCount() const;

 private:
  TransportOptions options_;
  std::shared_ptr<const TransportData> data_;
  std::shared_ptr<const std::vector<float>> node_open_;
  std::shared_ptr<const GlintNodes> glint_nodes_;                      ///< null: none
  std::shared_ptr<const std::vector<CompactSource>> compact_sources_;  ///< null: none
};

}  // namespace sunlit::light
