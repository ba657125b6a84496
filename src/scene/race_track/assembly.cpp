#include "scene/race_track/assembly.h"

#include <algorithm>
#include <cmath>

#include "scene/race_track/facade.h"

namespace sunlit::scene::race_track {
namespace {

constexpr float kCell_m = 64.0f;

Detail grain(float contrast, float coarsest_m, float finest_m, float gain) {
  Detail detail;
  detail.contrast = contrast;
  detail.coarsest_m = coarsest_m;
  detail.finest_m = finest_m;
  detail.gain = gain;
  return detail;
}

Material plain(const char* name, float roughness, const Detail& detail) {
  Material material;
  material.name = name;
  material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  material.roughness = roughness;
  material.detail = detail;
  return material;
}

}  // namespace

Assembly::Assembly() {
  palette_.matte = addMaterial(plain("matte", 0.7f, grain(0.10f, 2.0f, 0.01f, 0.75f)));
  palette_.satin = addMaterial(plain("satin", 0.35f, grain(0.06f, 1.5f, 0.02f, 0.7f)));
  palette_.metal = addMaterial(plain("metal", 0.5f, grain(0.14f, 1.5f, 0.01f, 0.8f)));
  palette_.concrete = addMaterial(plain("concrete", 0.9f, grain(0.20f, 3.0f, 0.01f, 0.85f)));
  palette_.plaster = addMaterial(plain("plaster", 0.9f, grain(0.13f, 4.0f, 0.02f, 0.8f)));
  palette_.roof = addMaterial(plain("roof", 0.85f, grain(0.22f, 2.0f, 0.05f, 0.9f)));
  palette_.wood = addMaterial(plain("wood", 0.8f, grain(0.25f, 1.0f, 0.01f, 0.9f)));
  palette_.rubber = addMaterial(plain("rubber", 0.85f, grain(0.20f, 0.8f, 0.01f, 0.9f)));
  palette_.glass = addMaterial(plain("glass", 0.08f, grain(0.20f, 1.5f, 0.05f, 0.8f)));
  palette_.bark = addMaterial(plain("bark", 0.95f, grain(0.35f, 0.6f, 0.01f, 0.9f)));
  palette_.stone = addMaterial(plain("stone", 0.9f, grain(0.30f, 1.0f, 0.01f, 0.9f)));
  Detail turf = grain(0.38f, 6.0f, 0.012f, 0.95f);
  turf.tint = {1.1f, 0.9f, 0.9f};
  palette_.grass = addMaterial(plain("grass", 1.0f, turf));
  palette_.gravel = addMaterial(plain("gravel", 0.95f, grain(0.35f, 2.0f, 0.015f, 1.1f)));
  palette_.cloth = addMaterial(plain("cloth", 0.9f, grain(0.12f, 1.0f, 0.02f, 0.8f)));
  Detail stalks = grain(0.40f, 0.5f, 0.01f, 1.0f);
  palette_.straw = addMaterial(plain("straw", 0.95f, stalks));
  const auto bulb = [this](const char* group, const LinearRgb& luminance) {
    Material material = plain(group, 0.08f, Detail());
    material.emission = luminance;
    material.lamp_group = group;
    return addMaterial(std::move(material));
  };
  palette_.street_lamp = bulb(kStreetLamps, kStreetLamp_cd * (1.0f / kStreetLamp_m2));
  palette_.grandstand_lamp = bulb(kGrandstandLamps, kGrandstandLamp_cd * (1.0f / kGrandstandLamp_m2));
}

int Assembly::addTexture(Texture texture) {
  scene_.textures.push_back(std::move(texture));
  return static_cast<int>(scene_.textures.size()) - 1;
}

int Assembly::addMaterial(Material material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<int>(scene_.materials.size()) - 1;
}

int Assembly::addPage(const std::string& name, const Sheet& sheet) {
  Texture texture;
  texture.name = name;
  texture.width = sheet.width_px;
  texture.height = sheet.height_px;
  texture.rgba.own().resize(static_cast<std::size_t>(texture.width) *
                            static_cast<std::size_t>(texture.height) * 4);
  return addTexture(std::move(texture));
}

void Assembly::openSheet(Sheet* sheet) {
  const std::string name = sheet->name + std::string(" ") + std::to_string(scene_.textures.size());
  Material material = plain(name.c_str(), 0.8f, sheet->masked ? Detail() : grain(0.07f, 1.0f, 0.01f, 0.8f));
  sheet->texture = addPage(name, *sheet);
  material.base_texture = sheet->texture;
  if (sheet->lit) {
    sheet->lit_texture = addPage("lit " + name, *sheet);
    material.emission = LinearRgb(Eigen::Array3f::Constant(kFullWindow_cd_per_m2));
    material.emission_map.texture = sheet->lit_texture;
    material.lamp_group = kWindowLamps;
  }
  if (sheet->masked) material.alpha_mode = AlphaMode::kMask;
  material.double_sided = sheet->double_sided;
  material.transmission = sheet->transmission;
  sheet->material = addMaterial(std::move(material));
  sheet->shelves.clear();
}

Assembly::Shelf* Assembly::findShelf(Sheet* sheet, int width, int height) {
  if (sheet->texture < 0) openSheet(sheet);
  Shelf* best = nullptr;
  int free_y = 0;
  for (Shelf& shelf : sheet->shelves) {
    free_y = shelf.y + shelf.height;
    const bool fits = shelf.height >= height && 4 * shelf.height <= 5 * height + 32;
    if (fits && shelf.filled + width <= sheet->width_px && (!best || shelf.height < best->height))
      best = &shelf;
  }
  if (best) return best;
  if (free_y + height > sheet->height_px) {
    openSheet(sheet);
    free_y = 0;
  }
  sheet->shelves.push_back({free_y, height, 0});
  return &sheet->shelves.back();
}

void Assembly::copyTo(int texture, const Canvas& canvas, const Eigen::Vector2i& corner) {
  const Texture picture = canvas.texture("");
  Texture& page = scene_.textures[static_cast<std::size_t>(texture)];
  std::uint8_t* const texels = page.rgba.own().data();
  const std::ptrdiff_t row = 4 * canvas.width();
  for (int y = 0; y < canvas.height(); ++y) {
    const auto from = picture.rgba.begin() + row * y;
    std::copy(from, from + row,
              texels + 4 * (static_cast<std::ptrdiff_t>(corner.y() + y) * page.width + corner.x()));
  }
}

Picture Assembly::place(const Canvas& canvas, Sheet* sheet, const Canvas* lit) {
  Shelf* shelf = findShelf(sheet, canvas.width(), canvas.height());
  copyTo(sheet->texture, canvas, {shelf->filled, shelf->y});
  if (lit) copyTo(sheet->lit_texture, *lit, {shelf->filled, shelf->y});
  const Eigen::Array2f corner(static_cast<float>(shelf->filled), static_cast<float>(shelf->y));
  const Eigen::Array2f extent(static_cast<float>(canvas.width()), static_cast<float>(canvas.height()));
  const Eigen::Array2f sheet_size(static_cast<float>(sheet->width_px), static_cast<float>(sheet->height_px));
  shelf->filled += canvas.width();
  // Half a pixel inside, so that filtering stays within.
  return {sheet->material,
          {((corner + 0.5f) / sheet_size).matrix(), ((corner + extent - 0.5f) / sheet_size).matrix()}};
}

Mesh& Assembly::mesh(int material, const Eigen::Vector3f& place) {
  const int i = static_cast<int>(std::floor(place.x() / kCell_m));
  const int j = static_cast<int>(std::floor(place.y() / kCell_m));
  Mesh& mesh = meshes_[{material, i, j}];
  if (mesh.name.empty()) {
    mesh.material = material;
    mesh.name = scene_.materials[material].name + " " + std::to_string(i) + " " + std::to_string(j);
  }
  return mesh;
}

Scene Assembly::finish(const std::string& name) {
  scene_.name = name;
  scene_.meshes = std::move(whole_);
  for (auto& entry : meshes_) scene_.meshes.push_back(std::move(entry.second));
  return std::move(scene_);
}

}  // namespace sunlit::scene::race_track
