/// The samples of one tile while triangles are drawn into it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/sample.h"
#include "render/screen_triangle.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::render {

class TileRaster {
 public:
  static constexpr int kLargest = 4 * light::Surfaces::kTileSize;  ///< samples a side

  /// A tile of samples; right and bottom inclusive, at most kLargest a side.
  struct Place {
    int left, top, right, bottom;
  };
  /// Everything sees the sky as yet, which hides what is beyond `far_m`.
  void start(const Place& place, float far_m);
  /// Masked triangles count texels between samples `texels_factor` times, squared.
  void draw(const ScreenTriangle& triangle, const std::vector<MaskPlanes>& masks, float texels_factor);
  /// Writes the tile to its place in rows of `stride` samples.
  void write(std::size_t stride, Sample* samples) const;

 private:
  struct Edges;
  struct Span {
    int row, left, right;
  };
  void fill(const ScreenTriangle& triangle, const Span& span);
  void fillMasked(const ScreenTriangle& triangle, const Span& span, const MaskPlanes& mask,
                  float texels_factor);
  struct MaskedRow;
  void fillMaskedPart(const MaskedRow& row, int first, int count, std::size_t at);
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>((row - place_.top) * kLargest + column - place_.left);
  }
  /// The part of the tile that a triangle may cover.
  struct Box {
    int left, right, top, bottom;  ///< inclusive
  };
  bool hides(const Box& box, float nearness_greatest) const;
  void updateFarthest();

  Place place_;
  static constexpr int kBlock = 8, kBlocks = kLargest / kBlock;  ///< samples a side, blocks a side
  /// Nothing in each block is farther: what is, is hidden. Updated now and then.
  std::array<float, kBlocks * kBlocks> farthest_;
  int drawn_since_update_ = 0;
  std::array<float, kLargest * kLargest> nearness_;  ///< 1 / depth, 1/m
  std::array<std::uint32_t, kLargest * kLargest> number_;
};

}  // namespace sunlit::render
