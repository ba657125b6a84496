#include "sunlit/render/baked_looks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "render/looks_charts.h"
#include "render/looks_paint.h"
#include "sunlit/scene/material_maps.h"

namespace sunlit::render {
namespace {

/// A chart is no finer than this share of the texel, however fine its own texture.
constexpr double kFinest = 0.25;
/// Most texels of a chart along a side.
constexpr int kLongestChart = BakedLooks::kLongestSide - 2 * Chart::kWidestGutter;

double distanceTo(const std::vector<Eigen::Vector3d>& eyes, const Chart& chart) {
  const Eigen::Vector3f half = 0.5f * (chart.extent_m[0] * chart.right + chart.extent_m[1] * chart.up);
  const Eigen::Vector3d middle = (chart.origin + half).cast<double>();
  double nearest = 1e300;
  for (const Eigen::Vector3d& eye : eyes) nearest = std::min(nearest, (eye - middle).squaredNorm());
  return std::max(std::sqrt(nearest) - static_cast<double>(half.norm()), 0.0);
}

/// What each chart is to have, before pages limit it.
void chooseTexels(const scene::Scene& scene, const BakedLooksOptions& options, std::vector<Chart>* charts) {
  tbb::parallel_for(std::size_t{0}, charts->size(), [&](std::size_t i) {
    Chart& chart = (*charts)[i];
    const scene::Mesh& mesh = scene.meshes[chart.mesh];
    const scene::Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    double texel = 1.0;  // of the option's
    if (material.base_texture != scene::Material::kNoTexture && !mesh.texture_coordinates.empty()) {
      const scene::Texture& own = scene.textures[static_cast<std::size_t>(material.base_texture)];
      texel = std::clamp(ownTexel(mesh, own, chart) / options.texel_m, kFinest, 1.0);
    }
    if (!options.eyes.empty()) texel *= std::max(1.0, distanceTo(options.eyes, chart) / BakedLooks::kNear_m);
    chart.texel_m = texel * options.texel_m;
  });
}

/// Sizes by `scale` times the texels of the charts. Returns how many of them a page makes coarser.
std::size_t choose(double scale, std::vector<Chart>* charts) {
  std::size_t coarser = 0;
  for (Chart& chart : *charts) {
    const Eigen::Array2d wanted = (chart.extent_m.cast<double>() / (scale * chart.texel_m)).ceil().max(1.0);
    if (wanted.maxCoeff() > kLongestChart) ++coarser;
    chart.size = wanted.min(static_cast<double>(kLongestChart)).cast<int>();
  }
  return coarser;
}

std::size_t texelsOf(const std::vector<Eigen::Array2i>& pages) {
  std::size_t sum = 0;
  for (const Eigen::Array2i& page : pages)
    sum += static_cast<std::size_t>(page[0]) * static_cast<std::size_t>(page[1]);
  return sum;
}

/// Of each channel the root, in steps of 1 / kTintSteps and 10 bits; kNoTint: as the material is.
using Tint = int;
constexpr Tint kNoTint = -1;
constexpr float kTintSteps = 32.0f;

Tint tintOf(const scene::Mesh& mesh, const std::array<std::uint32_t, 3>& v) {
  Eigen::Array3f color = Eigen::Array3f::Ones();
  if (!mesh.colors.empty()) color = (mesh.colors[v[0]] + mesh.colors[v[1]] + mesh.colors[v[2]]) / 3.0f;
  Tint tint = 0;
  for (int c = 2; c >= 0; --c)
    tint = tint * 1024 + static_cast<int>(std::lround(kTintSteps * std::sqrt(color[c])));
  return tint;
}

/// Some triangles of a mesh, with the vertices that they need.
class Part {
 public:
  Part(const scene::Mesh& whole, int material) : whole_(whole) {
    mesh_.name = whole.name;
    mesh_.material = material;
    mesh_.more_texture_coordinates.resize(whole.more_texture_coordinates.size());
  }

  void add(const std::array<std::uint32_t, 3>& v, std::size_t chart) {
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [known, is_new] =
          numbers_.insert({{chart, v[k]}, static_cast<std::uint32_t>(mesh_.positions.size())});
      triangle[k] = known->second;
      if (is_new) copy(v[k]);
    }
    mesh_.triangles.push_back(triangle);
  }
  scene::Mesh& mesh() { return mesh_; }

 private:
  void copy(std::uint32_t from) {
    mesh_.positions.push_back(whole_.positions[from]);
    mesh_.normals.push_back(whole_.normals[from]);
    if (!whole_.texture_coordinates.empty())
      mesh_.texture_coordinates.push_back(whole_.texture_coordinates[from]);
    for (std::size_t set = 0; set < whole_.more_texture_coordinates.size(); ++set) {
      if (!whole_.more_texture_coordinates[set].empty())
        mesh_.more_texture_coordinates[set].push_back(whole_.more_texture_coordinates[set][from]);
    }
    if (!whole_.tangents.empty()) mesh_.tangents.push_back(whole_.tangents[from]);
  }

  const scene::Mesh& whole_;
  scene::Mesh mesh_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> numbers_;  ///< by chart and vertex
};

/// Puts the scene together anew.
class Assembly {
 public:
  Assembly(const scene::Scene& scene, const std::vector<Chart>& charts,
           const std::vector<Eigen::Array2i>& pages)
      : scene_(scene), charts_(charts), pages_(pages) {
    made_.name = scene.name;
    made_.lamps = scene.lamps;
    made_.warnings = scene.warnings;
    std::size_t chart = 0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const scene::Mesh& mesh = scene.meshes[m];
      const Look look = lookOf(mesh, scene.materials[static_cast<std::size_t>(mesh.material)]);
      if (look == Look::kTinted) addTinted(mesh);
      if (look == Look::kAsItIs) {
        made_.meshes.push_back(mesh);
        made_.meshes.back().colors.clear();
        made_.meshes.back().material = materialOf({mesh.material, -1, kNoTint});
      }
      if (look != Look::kPainted) continue;
      const std::size_t begin = chart;
      while (chart < charts.size() && charts[chart].mesh == m) ++chart;
      addPainted(mesh, begin, chart);
    }
  }

  /// With the textures that its materials use: those of the scene, and `pages` behind them.
  scene::Scene with(std::vector<scene::Texture> pages) {
    std::map<int, int> numbers;
    const auto renumber = [&](int* texture) {
      if (*texture == scene::Material::kNoTexture) return;
      const auto [known, is_new] = numbers.insert({*texture, static_cast<int>(made_.textures.size())});
      if (is_new) {
        const auto number = static_cast<std::size_t>(*texture);
        made_.textures.push_back(number < scene_.textures.size()
                                     ? scene_.textures[number]
                                     : std::move(pages[number - scene_.textures.size()]));
      }
      *texture = known->second;
    };
    for (scene::Material& material : made_.materials) {
      renumber(&material.base_texture);
      for (scene::TextureUse* use : mapsOf(material)) renumber(&use->texture);
    }
    return std::move(made_);
  }
  /// Colours that were cut off at 1.
  const std::set<std::string>& cut() const { return cut_; }

 private:
  /// Material of the scene, page (or −1), tint.
  using Key = std::tuple<int, int, Tint>;

  int materialOf(const Key& key) {
    const auto [known, is_new] = materials_.insert({key, static_cast<int>(made_.materials.size())});
    if (!is_new) return known->second;
    const auto& [number, page, tint] = key;
    scene::Material material = scene_.materials[static_cast<std::size_t>(number)];
    material.detail = scene::Detail();
    if (page >= 0) {
      material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
      material.base_texture = static_cast<int>(scene_.textures.size()) + page;
      for (scene::TextureUse* use : mapsOf(material)) ++use->coordinates;
    }
    for (int c = 0; c < 3 && tint != kNoTint; ++c) {
      const float root = static_cast<float>((tint >> (10 * c)) & 1023) / kTintSteps;
      float& channel = material.base_color.value[c];
      channel *= root * root;
      if (channel > 1.0f) cut_.insert(material.name);
      channel = std::min(channel, 1.0f);
    }
    made_.materials.push_back(std::move(material));
    return known->second;
  }

  void addTinted(const scene::Mesh& mesh) {
    std::map<Tint, std::size_t> numbers;
    std::vector<Part> parts;
    for (const auto& v : mesh.triangles) {
      const Tint tint = tintOf(mesh, v);
      const auto [known, is_new] = numbers.insert({tint, parts.size()});
      if (is_new) parts.emplace_back(mesh, materialOf({mesh.material, -1, tint}));
      parts[known->second].add(v, 0);
    }
    for (Part& part : parts) made_.meshes.push_back(std::move(part.mesh()));
  }

  void addPainted(const scene::Mesh& mesh, std::size_t begin, std::size_t end) {
    std::map<int, std::size_t> numbers;
    std::vector<Part> parts;
    std::vector<std::vector<Eigen::Vector2f>> coordinates;
    for (std::size_t i = begin; i < end; ++i) {
      const Chart& chart = charts_[i];
      const auto [known, is_new] = numbers.insert({chart.page, parts.size()});
      if (is_new) {
        parts.emplace_back(mesh, materialOf({mesh.material, chart.page, kNoTint}));
        coordinates.emplace_back();
      }
      Part& part = parts[known->second];
      for (std::uint32_t k = 0; k < chart.count; ++k) part.add(mesh.triangles[chart.triangle + k], i);
      std::vector<Eigen::Vector2f>& on_page = coordinates[known->second];
      while (on_page.size() < part.mesh().positions.size())
        on_page.push_back(onPage(chart, part.mesh().positions[on_page.size()]));
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
      scene::Mesh& made = parts[p].mesh();
      const auto maps = mapsOf(made_.materials[static_cast<std::size_t>(made.material)]);
      if (std::any_of(maps.begin(), maps.end(), [](const auto* use) { return use->given(); }))
        made.more_texture_coordinates.insert(made.more_texture_coordinates.begin(),
                                             std::move(made.texture_coordinates));
      else
        made.more_texture_coordinates.clear();
      made.texture_coordinates = std::move(coordinates[p]);
      made_.meshes.push_back(std::move(made));
    }
  }

  Eigen::Vector2f onPage(const Chart& chart, const Eigen::Vector3f& position) const {
    const Eigen::Array2f corner(static_cast<float>(chart.x), static_cast<float>(chart.y));
    const Eigen::Array2f texels =
        corner + static_cast<float>(chart.gutter()) + chart.on(position) / chart.step_m();
    return (texels / pages_[static_cast<std::size_t>(chart.page)].cast<float>()).matrix();
  }

  const scene::Scene& scene_;
  const std::vector<Chart>& charts_;
  const std::vector<Eigen::Array2i>& pages_;
  scene::Scene made_;
  std::map<Key, int> materials_;
  std::set<std::string> cut_;
};

}  // namespace

struct BakedLooks::Plan {
  const scene::Scene& scene;
  std::vector<Chart> charts;
  std::vector<Eigen::Array2i> pages;
  std::vector<std::string> notes;

  Plan(const scene::Scene& scene_, const BakedLooksOptions& options)
      : scene(scene_), charts(chartsOf(scene_)) {
    chooseTexels(scene, options, &charts);
    const std::size_t coarser = choose(1.0, &charts);
    pages = packed(&charts);
    if (texelsOf(pages) > kMost) refuse(options.texel_m);
    if (coarser > 0) {
      double coarsest = 0.0;
      for (const Chart& chart : charts)
        coarsest = std::max(coarsest, static_cast<double>(chart.step_m().maxCoeff()));
      notes.push_back(std::to_string(coarser) + " surfaces are too large for a page of " +
                      std::to_string(kLongestSide) + " px, their texels are up to " + textOf(coarsest, 3) +
                      " m");
    }
    std::set<std::string> plain;
    for (const scene::Material& material : scene.materials) {
      if (material.detail.contrast > 0.0f && !canBePainted(material)) plain.insert(material.name);
    }
    if (!plain.empty())
      notes.push_back(
          std::to_string(plain.size()) +
          " materials are cut out, blend or are glass, and lose their fractal detail: " + *plain.begin());
    const Assembly assembly(scene, charts, pages);
    if (!assembly.cut().empty())
      notes.push_back(std::to_string(assembly.cut().size()) +
                      " materials would be brighter than white by their vertex colours, which are cut off: " +
                      *assembly.cut().begin());
  }

  /// Throws, naming a texel that fits.
  [[noreturn]] void refuse(double texel_m) {
    const double wanted = static_cast<double>(texelsOf(pages));
    double scale = 1.0;
    std::size_t texels = kMost + 1;
    while (texels > kMost) {
      scale *= 1.05;
      choose(scale, &charts);
      texels = texelsOf(packed(&charts));
      if (scale > 1e6) break;
    }
    char text[240];
    std::snprintf(
        text, sizeof text,
        "texel is %g m, which takes %.0f million texels, but there may be %.0f million; %.3f m fits", texel_m,
        1e-6 * wanted, 1e-6 * static_cast<double>(kMost), std::ceil(1000.0 * scale * texel_m) / 1000.0);
    throw std::invalid_argument(text);
  }
};

BakedLooks::BakedLooks(const scene::Scene& scene, const BakedLooksOptions& options) {
  requireFields(options);
  plan_ = std::make_unique<const Plan>(scene, options);
}

BakedLooks::~BakedLooks() = default;

std::size_t BakedLooks::pages() const {
  return plan_->pages.size();
}

std::size_t BakedLooks::texels() const {
  return texelsOf(plan_->pages);
}

const std::vector<std::string>& BakedLooks::notes() const {
  return plan_->notes;
}

scene::Scene BakedLooks::make(const std::function<void(double)>& done) const {
  const Plan& plan = *plan_;
  std::vector<scene::Texture> pages(plan.pages.size());
  for (std::size_t p = 0; p < pages.size(); ++p) {
    pages[p].name = "looks " + std::to_string(p);
    pages[p].width = plan.pages[p][0];
    pages[p].height = plan.pages[p][1];
    pages[p].wrap_u = pages[p].wrap_v = scene::Wrap::kClamp;
    pages[p].rgba.own().assign(4 * static_cast<std::size_t>(plan.pages[p].prod()), 255);
  }
  const TexturePyramids pyramids(plan.scene);
  std::mutex telling;
  std::size_t texels = 0;
  tbb::parallel_for(std::size_t{0}, plan.charts.size(), [&](std::size_t i) {
    const Chart& chart = plan.charts[i];
    const std::int32_t material = plan.scene.meshes[chart.mesh].material;
    paintChart(plan.scene, pyramids.of(material), chart, &pages[static_cast<std::size_t>(chart.page)]);
    const std::lock_guard<std::mutex> lock(telling);
    texels += static_cast<std::size_t>(chart.room.prod());
    if (done) done(static_cast<double>(texels) / static_cast<double>(this->texels()));
  });
  return Assembly(plan.scene, plan.charts, plan.pages).with(std::move(pages));
}

}  // namespace sunlit::render
