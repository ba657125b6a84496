#include "scene/sdf_model_folder.h"

#include <tinyxml2.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;

/// n of version 1.n; 0 where it does not say.
int minorVersion(const tinyxml2::XMLElement& sdf) {
  const char* version = sdf.Attribute("version");
  const std::string text = version == nullptr ? "" : version;
  return text.compare(0, 2, "1.") == 0 ? std::atoi(text.c_str() + 2) : 0;
}

/// What a manifest names.
std::string fileNamedBy(const fs::path& manifest) {
  constexpr int kNewest = 9;  // that libsdformat 12 reads
  std::error_code error;
  tinyxml2::XMLDocument document;
  if (!fs::is_regular_file(manifest, error) || document.LoadFile(manifest.c_str()) != tinyxml2::XML_SUCCESS)
    return {};
  const tinyxml2::XMLElement* model = document.FirstChildElement("model");
  std::string name;
  int best = -1;
  for (const auto* sdf = model == nullptr ? nullptr : model->FirstChildElement("sdf"); sdf != nullptr;
       sdf = sdf->NextSiblingElement("sdf")) {
    const int version = minorVersion(*sdf);
    const int worth = version <= kNewest ? version + kNewest : kNewest - 1 - version;
    if (sdf->GetText() == nullptr || (!name.empty() && worth <= best)) continue;
    name = sdf->GetText();
    best = worth;
  }
  const auto* const urdf = name.empty() && model != nullptr ? model->FirstChildElement("urdf") : nullptr;
  if (urdf != nullptr && urdf->GetText() != nullptr) name = urdf->GetText();
  const std::size_t begin = name.find_first_not_of(" \t\r\n");
  return begin == std::string::npos ? "" : name.substr(begin, name.find_last_not_of(" \t\r\n") + 1 - begin);
}

}  // namespace

std::string modelFileOf(const std::string& place) {
  std::error_code error;
  if (!fs::is_directory(place, error)) return place;
  for (const char* manifest : {"model.config", "manifest.xml"}) {
    const std::string name = fileNamedBy(fs::path(place) / manifest);
    if (!name.empty() && fs::is_regular_file(fs::path(place) / name, error))
      return (fs::path(place) / name).lexically_normal().string();
  }
  const fs::path usual = fs::path(place) / "model.sdf";
  return fs::is_regular_file(usual, error) ? usual.lexically_normal().string() : std::string();
}

}  // namespace sunlit::scene
