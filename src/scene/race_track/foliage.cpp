#include "scene/race_track/foliage.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

struct LeafStyle {
  Color dark;
  Color light;
  float length_px;
  float slimness;  // width over length
  int count;
};

LeafStyle leafStyle(Species species) {
  switch (species) {
    case Species::kOak:
      return {{0.020f, 0.048f, 0.012f}, {0.085f, 0.135f, 0.030f}, 17.0f, 0.50f, 1900};
    case Species::kBirch:
      return {{0.040f, 0.075f, 0.018f}, {0.150f, 0.190f, 0.045f}, 11.0f, 0.60f, 2900};
    case Species::kMaple:
      return {{0.030f, 0.062f, 0.012f}, {0.130f, 0.165f, 0.028f}, 21.0f, 0.75f, 1150};
    case Species::kLime:
      return {{0.026f, 0.060f, 0.016f}, {0.100f, 0.170f, 0.050f}, 15.0f, 0.80f, 1800};
    case Species::kCopperBeech:
      return {{0.035f, 0.014f, 0.014f}, {0.130f, 0.045f, 0.038f}, 14.0f, 0.6f, 2000};
    case Species::kSpruce:
      return {{0.014f, 0.034f, 0.018f}, {0.050f, 0.085f, 0.040f}, 20.0f, 0.09f, 6400};
    case Species::kPine:
      return {{0.022f, 0.042f, 0.018f}, {0.085f, 0.110f, 0.045f}, 30.0f, 0.06f, 4000};
  }
  return {};
}

void addTwigs(Canvas& canvas, Random& random) {
  const float size = static_cast<float>(canvas.width());
  for (int i = 0; i < 14; ++i) {
    const float angle = random.range(0.0f, 2.0f * kPiFloat);
    const Pixel middle(0.5f * size, 0.5f * size);
    const Pixel out = 0.45f * size * random.range(0.5f, 1.0f) * Pixel(std::cos(angle), std::sin(angle));
    const Pixel bent = middle + 0.5f * out + 20.0f * scatter(random);
    canvas.line({middle, bent, middle + out}, random.range(1.5f, 3.5f), {{0.07f, 0.055f, 0.04f}, 1.0f});
  }
}

// A conifer's branch, from the trunk at the left to its tip at the right: side twigs like the bones of a
// fish, with needles along them. The gaps between the twigs are wide enough to show from afar.
Canvas paintNeedles(Species species, std::uint32_t variant) {
  constexpr int kSize = 340;
  constexpr int kPairs = 8;
  const LeafStyle style = leafStyle(species);
  Random random(301u + variant, static_cast<std::uint32_t>(species));
  Canvas canvas(kSize, kSize, 0.5f * (style.dark + style.light), 0.0f);
  const Ink wood{{0.06f, 0.045f, 0.03f}, 1.0f};
  canvas.line({{0.02f * kSize, 0.5f * kSize}, {0.92f * kSize, 0.5f * kSize}}, 5.0f, wood);
  struct Twig {
    Pixel root, tip;
  };
  std::vector<Twig> twigs = {{{0.3f * kSize, 0.5f * kSize}, {0.97f * kSize, 0.5f * kSize}}};
  for (int i = 0; i < 2 * kPairs; ++i) {
    const float along = (static_cast<float>(i / 2) + random.unit()) / kPairs;
    const float length = kSize * (0.46f - 0.30f * along) * random.range(0.75f, 1.0f);
    const float angle = (i % 2 == 0 ? 1.0f : -1.0f) * random.range(0.75f, 1.15f);
    const Pixel root(kSize * (0.04f + 0.78f * along), 0.5f * kSize);
    twigs.push_back({root, root + length * Pixel(std::cos(angle), std::sin(angle))});
    canvas.line({twigs.back().root, twigs.back().tip}, 2.5f, wood);
  }
  for (int i = 0; i < style.count; ++i) {
    const Twig& twig = twigs[static_cast<std::size_t>(random.below(static_cast<int>(twigs.size())))];
    const Pixel way = twig.tip - twig.root;
    const float at = random.range(0.08f, 1.0f);
    const Pixel off = 0.008f * kSize * scatter(random);
    const Pixel place = twig.root + at * way + off;
    if ((place.array() < 0.03f * kSize).any() || (place.array() > 0.97f * kSize).any()) continue;
    const float lit = 0.35f + 0.65f * static_cast<float>(i) / static_cast<float>(style.count);
    const float gloss = random.range(1.0f, 1.7f);
    const Color color = (style.dark + lit * random.unit() * (style.light - style.dark)) * gloss;
    const float length = style.length_px * random.range(0.6f, 1.2f);
    const float turn = std::atan2(way.y(), way.x()) + 0.65f * random.bell();
    canvas.ellipse(place, {0.5f * length, std::max(0.9f, 0.5f * length * style.slimness)}, turn,
                   {color, 1.0f});
  }
  return canvas;
}

// A spray of leaves: clumps along its twigs, with gaps between them that show from afar, too.
Canvas paintLeaves(Species species, std::uint32_t variant) {
  constexpr int kSize = 340;
  constexpr int kClumps = 23;
  const LeafStyle style = leafStyle(species);
  Random random(301u + variant, static_cast<std::uint32_t>(species));
  Canvas canvas(kSize, kSize, 0.5f * (style.dark + style.light), 0.0f);
  addTwigs(canvas, random);
  std::vector<Pixel> clumps;
  for (int i = 0; i < kClumps; ++i) {
    const float angle = 2.39996f * static_cast<float>(i) + 0.5f * random.bell();
    const float radius =
        0.43f * kSize * std::sqrt((static_cast<float>(i) + 0.5f) / kClumps) * random.range(0.75f, 1.05f);
    clumps.push_back(Pixel(0.5f * kSize, 0.5f * kSize) + radius * Pixel(std::cos(angle), std::sin(angle)));
  }
  for (int i = 0; i < style.count; ++i) {
    const int k = random.below(kClumps);
    const Pixel off = 0.052f * kSize * scatter(random);
    const Pixel place = clumps[k] + off;
    if ((place.array() < 0.03f * kSize).any() || (place.array() > 0.97f * kSize).any()) continue;
    // Later leaves lie on top and catch more light.
    const float lit = 0.35f + 0.65f * static_cast<float>(i) / static_cast<float>(style.count);
    const float gloss = random.range(1.0f, 1.7f);
    const Color color = (style.dark + lit * random.unit() * (style.light - style.dark)) * gloss;
    const float length = style.length_px * random.range(0.6f, 1.2f);
    const float turn = random.range(0.0f, kPiFloat);
    const Pixel radii(0.5f * length,
                      std::max(0.9f, 0.5f * length * style.slimness * random.range(0.6f, 1.1f)));
    canvas.ellipse(place, radii, turn, {color, 1.0f});
    const Pixel rib = 0.4f * length * Pixel(std::cos(turn), std::sin(turn));
    canvas.line({place - rib, place + rib}, 0.8f, {1.5f * color, 0.6f});
  }
  return canvas;
}

// Blades, stalks and flowers that grow from the lower edge.
Canvas paintTuft(std::uint32_t which) {
  constexpr int kSize = 256;
  Random random(311u, which);
  Canvas canvas(kSize, kSize, {0.12f, 0.15f, 0.05f}, 0.0f);
  const int blades = 55 + random.below(40);
  for (int i = 0; i < blades; ++i) {
    const float root = kSize * (0.5f + 0.19f * random.bell());
    const float height = kSize * random.range(0.35f, 0.95f);
    const float lean = 0.35f * height * random.bell();
    const Color tone = random.chance(0.22f) ? Color(0.27f, 0.22f, 0.10f) : Color(0.085f, 0.14f, 0.035f);
    const Ink ink{tone * random.range(0.6f, 1.5f), 1.0f};
    constexpr int kSteps = 7;
    for (int k = 0; k < kSteps; ++k) {
      const auto at = [&](float t) {
        return Pixel(root + lean * t * t, kSize - height * (t - 0.18f * t * t * std::abs(lean) / height));
      };
      const float t = static_cast<float>(k) / kSteps;
      canvas.line({at(t), at(t + 1.0f / kSteps)}, 1.2f + 5.0f * (1.0f - t), ink);
    }
  }
  const Color petals[] = {
      {0.75f, 0.72f, 0.65f}, {0.70f, 0.48f, 0.03f}, {0.35f, 0.12f, 0.40f}, {0.55f, 0.06f, 0.05f}};
  if (which >= 4) {
    for (int i = 0; i < 4 + random.below(6); ++i) {
      const float y = kSize * random.range(0.05f, 0.5f);
      const Pixel head(kSize * random.range(0.2f, 0.8f), y);
      canvas.line({head, {0.5f * (head.x() + 0.5f * kSize), static_cast<float>(kSize)}}, 2.5f,
                  {{0.09f, 0.12f, 0.04f}, 1.0f});
      for (int k = 0; k < 6; ++k) {
        const Pixel off = 6.0f * Pixel(std::cos(1.05f * k), std::sin(1.05f * k));
        canvas.ellipse(head + off, {6.0f, 4.0f}, 1.05f * k, {petals[which % 4], 1.0f});
      }
      canvas.ellipse(head, {4.0f, 4.0f}, 0.0f, {{0.45f, 0.30f, 0.03f}, 1.0f});
    }
  }
  return canvas;
}

}  // namespace

Foliage paintFoliage(Assembly& assembly) {
  constexpr int kLeafCount = kSpeciesCount * kVariants;
  constexpr int kCount = kLeafCount + kTufts;
  std::vector<Canvas> canvases(kCount, Canvas(1, 1, Color::Zero()));
  tbb::parallel_for(0, kCount, [&](int i) {
    const auto n = static_cast<std::uint32_t>(i);
    const auto species = static_cast<Species>(i / kVariants);
    const bool conifer = species == Species::kSpruce || species == Species::kPine;
    canvases[i] = i >= kLeafCount ? paintTuft(n - kLeafCount)
                  : conifer       ? paintNeedles(species, n)
                                  : paintLeaves(species, n);
  });
  Foliage foliage;
  for (int i = 0; i < kCount; ++i) {
    const Picture picture =
        i < kLeafCount ? assembly.addLeaves(canvases[i]) : assembly.addBlades(canvases[i]);
    (i < kLeafCount ? foliage.leaves[i / kVariants][i % kVariants] : foliage.tufts[i - kLeafCount]) = picture;
  }
  return foliage;
}

}  // namespace sunlit::scene::race_track
