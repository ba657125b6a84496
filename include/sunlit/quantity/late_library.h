/// Libraries of ours that are loaded when first asked, since what they are made with takes longer to load
/// than most programs run.
#pragma once

#include <string>

namespace sunlit {

/// The address of what `library` exports by this name. `library` is the name of its file, which lies beside
/// the library of this function, as every one of sunlit's does. It stays loaded. Throws std::runtime_error,
/// saying what to do, where the file cannot be loaded or has no such name.
void* addressIn(const std::string& library, const std::string& name);

/// As `Function*`, of a function that is exported as extern "C".
template <typename Function>
Function* functionIn(const std::string& library, const std::string& name) {
  return reinterpret_cast<Function*>(addressIn(library, name));
}

}  // namespace sunlit
