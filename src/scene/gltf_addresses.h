/// What glTF files carry in their addresses.
#pragma once

#include <nlohmann/json.hpp>

namespace sunlit::scene {

/// Makes the data addresses (RFC 2397) of buffers and images such ones as all readers know: base64, without
/// escapes. Whether there were others.
bool usePlainAddresses(nlohmann::json& root);

}  // namespace sunlit::scene
