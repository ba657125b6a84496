#include "tools/comparison_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "sunlit/image/exposure.h"
#include "sunlit/image/files.h"

namespace sunlit::tools {
namespace {

/// Of a row: its light, its errors, and what stands for these where it has no pixels.
struct Format {
  const char *light, *errors, *none;
};
constexpr Format kCsv = {",%.5g", ",%.3f,%.3f,%.3f,%.3f,%.3f,%.4f\n", ",,,,,,\n"};
constexpr Format kMarkdown = {" | %.4g", " | %.2f | %.2f | %.2f | %+.2f | %.2f | %.3f |\n",
                              " | – | – | – | – | – | – |\n"};

std::string line(const Format& format, const ComparisonRow& row) {
  char light[64], errors[256];
  std::snprintf(light, sizeof light, format.light, row.illuminance_lx);
  const light::LuminanceError& e = row.error;
  std::snprintf(errors, sizeof errors, format.errors, 100.0 * e.mean, 100.0 * e.median, 100.0 * e.p95,
                100.0 * e.bias, 100.0 * e.noise, row.flip);
  return std::string(light) + (e.pixels > 0 ? errors : format.none);
}

/// The mean of `rows`, which say the same of different views. Those that see no surface have no error.
ComparisonRow meanOf(const std::vector<const ComparisonRow*>& rows) {
  ComparisonRow mean = *rows.front();
  mean.error = {};
  mean.flip = 0.0;
  const auto has_pixels = [](const ComparisonRow* row) { return row->error.pixels > 0; };
  const auto count = static_cast<double>(std::count_if(rows.begin(), rows.end(), has_pixels));
  for (const ComparisonRow* row : rows) {
    if (!has_pixels(row)) continue;
    mean.error.pixels += row->error.pixels;
    mean.error.mean += row->error.mean / count;
    mean.error.median += row->error.median / count;
    mean.error.p95 += row->error.p95 / count;
    mean.error.bias += row->error.bias / count;
    mean.error.noise += row->error.noise / count;
    mean.flip += row->flip / count;
  }
  return mean;
}

std::string csv(const std::vector<ComparisonRow>& rows) {
  std::string text =
      "view,sky,pixels,illuminance_lx,mean_pct,median_pct,p95_pct,bias_pct,noise_pct,hdr_flip\n";
  for (const ComparisonRow& row : rows) {
    text +=
        std::to_string(row.view) + "," + row.sky + "," + std::to_string(row.error.pixels) + line(kCsv, row);
  }
  return text;
}

std::string markdown(const std::vector<ComparisonRow>& rows) {
  std::string text =
      "Relative error of luminance against the traced reference, %, over pixels that see a surface.\n\n"
      "| view | sky | lx | mean | median | p95 | bias | noise of the reference | HDR-FLIP |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  std::map<std::string, std::vector<const ComparisonRow*>> by_sky;
  std::vector<std::string> skies;
  for (const ComparisonRow& row : rows) {
    if (by_sky[row.sky].empty()) skies.push_back(row.sky);
    by_sky[row.sky].push_back(&row);
    text += "| " + std::to_string(row.view) + " | " + row.sky + line(kMarkdown, row);
  }
  for (const std::string& sky : skies) text += "| **all** | " + sky + line(kMarkdown, meanOf(by_sky[sky]));
  std::vector<const ComparisonRow*> all;
  for (const ComparisonRow& row : rows) all.push_back(&row);
  if (!all.empty()) {
    ComparisonRow mean = meanOf(all);
    mean.illuminance_lx = NAN;  // of different skies: no mean is told
    std::string cells = line(kMarkdown, mean);
    text += "| **all** | **all**" + cells.replace(cells.find("nan"), 3, "–");
  }
  return text;
}

/// Of a relative error: the square root, so that a few percent can be seen.
std::uint8_t shade(float error) {
  return static_cast<std::uint8_t>(255.0f * std::sqrt(std::clamp(error / 0.5f, 0.0f, 1.0f)));
}

}  // namespace

void ErrorByMaterial::add(const light::Surfaces& surfaces, const image::Picture<float, 1>& errors) {
  std::vector<std::uint32_t> most(errors.data.size(), 0);
  std::vector<std::int32_t> material(errors.data.size(), 0);
  for (const light::Tile& tile : surfaces.tiles) {
    for (const light::Surface& surface : tile.surfaces) {
      if (surface.samples <= most[surface.pixel]) continue;
      most[surface.pixel] = surface.samples;
      material[surface.pixel] = surface.material;
    }
  }
  for (std::size_t i = 0; i < most.size(); ++i) {
    if (most[i] == 0) continue;
    Sum& sum = sums_[material[i]];
    ++sum.pixels;
    sum.absolute += static_cast<double>(std::abs(errors.data[i]));
    sum.positive_and_negative += static_cast<double>(errors.data[i]);
  }
}

void ErrorByMaterial::write(const std::string& folder, const scene::Scene& scene) const {
  std::vector<std::pair<std::int32_t, Sum>> sorted(sums_.begin(), sums_.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second.absolute > b.second.absolute; });
  std::size_t pixels = 0;
  for (const auto& entry : sorted) pixels += entry.second.pixels;
  std::string text =
      "| material | share of pixels, % | mean error, % | of it one-sided, % | adds to the mean, % |\n"
      "|---|---|---|---|---|\n";
  for (const auto& [material, sum] : sorted) {
    char cells[128];
    const auto count = static_cast<double>(sum.pixels);
    std::snprintf(cells, sizeof cells, " | %.2f | %.2f | %+.2f | %.2f |\n",
                  100.0 * count / static_cast<double>(pixels), 100.0 * sum.absolute / count,
                  100.0 * sum.positive_and_negative / count,
                  100.0 * sum.absolute / static_cast<double>(pixels));
    text += "| " + scene.materials[static_cast<std::size_t>(material)].name + cells;
  }
  image::writeFileAtomically(folder + "/materials.md", text);
}

void writeTables(const std::string& folder, const std::vector<ComparisonRow>& rows) {
  image::writeFileAtomically(folder + "/table.csv", csv(rows));
  image::writeFileAtomically(folder + "/table.md", markdown(rows));
}

image::Rgb8Image sideBySide(const image::LinearImage& fast, const image::LinearImage& traced,
                            const image::Picture<float, 1>& errors) {
  // Small pictures are enlarged, so that pixels can be told apart.
  const int zoom = std::max(1, 400 / traced.width);
  const double ev100 = image::chooseEv100(traced, image::ExposureOptions());
  const image::Rgb8Image left = image::develop(fast, ev100), middle = image::develop(traced, ev100);
  image::Rgb8Image right(traced.width, traced.height);
  for (std::size_t i = 0; i < errors.data.size(); ++i) {
    right.data[3 * i] = shade(errors.data[i]);
    right.data[3 * i + 2] = shade(-errors.data[i]);
  }
  const int width = traced.width * zoom;
  image::Rgb8Image sheet(3 * width, traced.height * zoom);
  const image::Rgb8Image* columns[] = {&left, &middle, &right};
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) {
      std::copy_n(columns[x / width]->at(x % width / zoom, y / zoom), 3, sheet.at(x, y));
    }
  }
  return sheet;
}

}  // namespace sunlit::tools
