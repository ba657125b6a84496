/// The air of sky::AtmosphereOptions(), which half of the tests of pictures look through.
#pragma once

#include <dlfcn.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include "sunlit/sky/atmosphere.h"
#include "support/usual_air.h"

namespace sunlit::sky {

/// Keeps tables beside the library that makes them, for the next test program, until it is built again.
class TablesOfThisBuild {
 public:
  TablesOfThisBuild() {
    Dl_info found{};
    if (dladdr(reinterpret_cast<const void*>(static_cast<void (*)(const AtmosphereOptions&)>(&validate)),
               &found) != 0)
      library_ = found.dli_fname;
  }

  TableStore store() const {
    if (library_.empty()) return {};
    return {[*this](const std::string& name) { return find(name); },
            [*this](const std::string& name, const std::vector<float>& numbers) { keep(name, numbers); }};
  }

 private:
  std::string fileOf(const std::string& name) const {
    return library_ + ".tables_" + std::to_string(std::hash<std::string>()(name));
  }

  std::vector<float> find(const std::string& name) const {
    std::error_code missing;
    const auto made = std::filesystem::last_write_time(fileOf(name), missing);
    if (missing || made < std::filesystem::last_write_time(library_, missing)) return {};
    std::ifstream file(fileOf(name), std::ios::binary);
    std::vector<float> numbers(static_cast<std::size_t>(std::filesystem::file_size(fileOf(name))) /
                               sizeof(float));
    file.read(reinterpret_cast<char*>(numbers.data()),
              static_cast<std::streamsize>(numbers.size() * sizeof(float)));
    return file ? numbers : std::vector<float>();
  }

  void keep(const std::string& name, const std::vector<float>& numbers) const {
    const std::string part =
        fileOf(name) + '_' + std::to_string(::getpid());  // two programs may make them at once
    std::ofstream(part, std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::streamsize>(numbers.size() * sizeof(float)));
    std::error_code lost;  // then the next program makes them, too
    std::filesystem::rename(part, fileOf(name), lost);
  }

  std::string library_;
};

inline const Atmosphere& usualAir() {
  static const Atmosphere air(AtmosphereOptions(), TablesOfThisBuild().store());
  return air;
}

}  // namespace sunlit::sky
