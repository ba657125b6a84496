/// What elevation models in TIFF have where nothing was measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sunlit::image {

/// The number that tag 42113 (GDAL_NODATA) of the first picture in a TIFF file tells; nothing where there is
/// no such tag, or no finite number, of other files, and of BigTIFF.
std::optional<double> tiffNoData(const std::uint8_t* bytes, std::size_t size);

}  // namespace sunlit::image
