/// A bake on disk.
#pragma once

#include <filesystem>
#include <memory>

#include "light/bake/cache/bake_key.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Where the file can be mapped, without a copy (image::FileBytes). Throws std::runtime_error with the path
/// and what is wrong: it can't be read, is cut short, is damaged, is
/// of another version, or is of another bake than `key`.
std::unique_ptr<const TransportData> readBake(const std::filesystem::path& file,
                                              const image::ContentHash& key);

/// Complete or not at all, also where the power fails: written beside `file` first, and durable before it
/// gets that name. Throws std::runtime_error with the path.
void writeBake(const std::filesystem::path& file, const image::ContentHash& key, const TransportData& data);

}  // namespace sunlit::light
