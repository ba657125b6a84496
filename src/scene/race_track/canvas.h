/// A picture to paint textures on: linear colour with opacity, soft-edged brushes, lettering.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene/noise.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene::race_track {

using Color = Eigen::Array3f;   ///< linear reflectance
using Pixel = Eigen::Vector2f;  ///< x to the right, y down, px; pixel centres at halves

struct Ink {
  Color color;
  float opacity = 1.0f;
};

/// Where letters go: their top left corner, and the steps to the right and downwards by one letter height.
struct LetterFrame {
  Pixel corner;
  Pixel right;
  Pixel down;
};

class Canvas {
 public:
  Canvas(int width, int height, const Color& color, float alpha = 1.0f);

  int width() const { return width_; }
  int height() const { return height_; }
  const Color& color(int x, int y) const { return colors_[static_cast<std::size_t>(y) * width_ + x]; }
  Color& color(int x, int y) { return colors_[static_cast<std::size_t>(y) * width_ + x]; }
  float& alpha(int x, int y) { return alphas_[static_cast<std::size_t>(y) * width_ + x]; }
  void blend(int x, int y, const Ink& ink);

  void rectangle(const Pixel& low, const Pixel& high, const Ink& ink);
  void ellipse(const Pixel& centre, const Pixel& radii, float turn, const Ink& ink);
  void polygon(const std::vector<Pixel>& corners, const Ink& ink);
  /// A line through the points, soft-edged, of the given width.
  void line(const std::vector<Pixel>& points, float width, const Ink& ink);
  /// Capitals, digits and a few signs; anything else is a gap. `place` is the top left corner; letters are
  /// `height` px high.
  void text(const std::string& letters, const Pixel& place, float height, const Ink& ink);
  void text(const std::string& letters, const LetterFrame& frame, const Ink& ink);
  /// Multiplies every colour by 1 + strength · fractal noise of the given wavelength.
  void mottle(float wavelength_px, float strength, std::uint32_t seed);
  /// Dark runs of dirt from the top edge downwards, as rain leaves them.
  void streaks(int count, float opacity, Random& random);

  /// sRGB-encoded.
  Texture texture(const std::string& name) const;

 private:
  int width_;
  int height_;
  std::vector<Color> colors_;
  std::vector<float> alphas_;
};

/// A random offset, of standard deviation 1 px along either axis.
Pixel scatter(Random& random);

/// The width of `letters` as Canvas::text draws them `height` px high, px.
float textWidth(const std::string& letters, float height);

/// Linear reflectance of 8-bit sRGB components.
Color srgb(int red, int green, int blue);

}  // namespace sunlit::scene::race_track
