#include "sunlit/quantity/late_library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace sunlit {

void* addressIn(const std::string& library, const std::string& name) {
  Dl_info own{};
  std::string file = library;
  if (dladdr(reinterpret_cast<const void*>(&addressIn), &own) != 0 && own.dli_fname != nullptr)
    file = std::filesystem::path(own.dli_fname).replace_filename(library).string();
  void* const loaded = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* const address = loaded == nullptr ? nullptr : dlsym(loaded, name.c_str());
  if (address != nullptr) return address;
  const char* const reason = dlerror();
  throw std::runtime_error(file + ": a part of sunlit cannot be loaded (" +
                           (reason == nullptr ? "no reason is told" : reason) +
                           "): build or install sunlit again");
}

}  // namespace sunlit
