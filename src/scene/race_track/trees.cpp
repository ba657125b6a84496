#include <cmath>

#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/plants.h"
#include "scene/race_track/shapes.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

struct Tree {
  Point root;
  Species species;
  float height;
  float detail;  // 1 near the track, less farther off
  std::uint32_t seed;
};

Point direction(Random& random) {
  const float z = random.range(-1.0f, 1.0f);
  const float angle = random.range(0.0f, 2.0f * kPiFloat);
  const float r = std::sqrt(1.0f - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A tint whose red varies by this standard deviation, and its blue by 0.1.
Color leafHue(float red_spread, Random& random) {
  const float blue = 1.0f + 0.1f * random.bell();
  const float red = 1.0f + red_spread * random.bell();
  return Color(red, 1.0f, blue).max(0.4f);
}

struct Leaves {
  Picture picture;
  Color tint;
};

struct Spray {
  Point centre;
  Point normal;
  float size;
  Point crown;  // what its leaves turn away from
};

// One card of leaves: any part of the picture, any way round. Its normals spread from the middle of the
// crown, so that cards share in the shading of one round crown instead of each showing as a plate.
void addSpray(Assembly& assembly, const Leaves& leaves, const Spray& spray, Random& random) {
  const Point facing = (spray.normal + 0.6f * direction(random)).normalized();
  const Point u0 = facing.unitOrthogonal();
  const Point v0 = facing.cross(u0);
  const float turn = random.range(0.0f, 2.0f * kPiFloat);
  const float half = 0.5f * spray.size;
  const Point u = half * (std::cos(turn) * u0 + std::sin(turn) * v0);
  const Point v = half * random.range(0.75f, 1.1f) * (std::cos(turn) * v0 - std::sin(turn) * u0);
  const Point& c = spray.centre;
  Card card{{c - u - v, c + u - v, c + u + v, c - u + v}, {}, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    card.normals[i] = ((card.corners[i] - spray.crown).normalized() + 0.7f * spray.normal).normalized();
  }
  const Eigen::Vector2f& a = leaves.picture.rect.top_left;
  const Eigen::Vector2f& b = leaves.picture.rect.bottom_right;
  card.rect = random.chance(0.5f) ? PictureRect{a, b} : PictureRect{{b.x(), a.y()}, {a.x(), b.y()}};
  addCard(assembly, {leaves.picture.material, leaves.tint}, card);
}

Color barkColor(Species species) {
  if (species == Species::kBirch) return {0.42f, 0.40f, 0.36f};
  if (species == Species::kPine) return {0.165f, 0.108f, 0.072f};
  return {0.11f, 0.085f, 0.065f};
}

struct FoliageBlob {
  Point centre;
  float radius;
  Point crown;  // middle of the whole crown
  int sprays;
  const std::array<Picture, kVariants>& pictures;
  Color tint;
};

void addFoliageBlob(Assembly& assembly, const Tree& tree, const FoliageBlob& blob, Random& random) {
  for (int k = 0; k < blob.sprays; ++k) {
    const Point way = direction(random);
    const Point place = blob.centre + blob.radius * way * std::cbrt(random.range(0.25f, 1.0f));
    if (place.z() < tree.root.z() + 0.16f * tree.height) continue;
    // Dark inside and below, light at the top.
    const float shade =
        0.62f + 0.75f * (place.z() - blob.crown.z()) / tree.height + 0.16f * way.z() + 0.10f * random.bell();
    const Leaves leaves{blob.pictures[random.below(kVariants)], blob.tint * std::clamp(shade, 0.35f, 1.25f)};
    const Point normal = ((place - blob.crown).normalized() + 0.6f * way + Point(0, 0, 0.35f)).normalized();
    const float size = blob.radius * random.range(0.65f, 1.1f) * (tree.detail > 0.5f ? 1.1f : 1.6f);
    addSpray(assembly, leaves, {place, normal, size, blob.crown}, random);
  }
}

void addBroadLeaf(Assembly& assembly, const Foliage& foliage, const Tree& tree) {
  Random random(tree.seed);
  const Paint bark{assembly.palette().bark, barkColor(tree.species) * random.range(0.75f, 1.2f)};
  const float h = tree.height;
  const Point lean = sway(0.05f * h, random);
  const float girth = 0.013f * h * random.range(0.8f, 1.3f);
  const Point fork = tree.root + 0.5f * lean + Point(0, 0, random.range(0.20f, 0.34f) * h);
  const Point top = tree.root + lean + Point(0, 0, 0.82f * h);
  addTube(assembly, bark,
          {{tree.root - Point(0, 0, 0.3f), 1.5f * girth},
           {tree.root + Point(0, 0, 0.05f * h), girth},
           {fork, 0.8f * girth},
           {top, 0.15f * girth}},
          tree.detail > 0.5f ? 7 : 4);
  const float spread = h *
                       (tree.species == Species::kBirch  ? 0.21f
                        : tree.species == Species::kLime ? 0.28f
                                                         : 0.34f) *
                       random.range(0.85f, 1.15f);
  const Point middle = 0.5f * (fork + top) + Point(0, 0, 0.10f * h);
  const auto& pictures = foliage.leaves[static_cast<int>(tree.species)];
  const int blobs = tree.detail > 0.5f ? 12 : 7;
  const int sprays = static_cast<int>((tree.detail > 0.5f ? 84.0f : 38.0f) / blobs * (0.7f + 0.04f * h));
  const float shade = random.range(0.8f, 1.2f);
  const Color tint = leafHue(0.14f, random) * shade;
  for (int i = 0; i < blobs; ++i) {
    Point out = direction(random);
    out.z() = 0.25f + 0.75f * out.z();
    const Point blob =
        middle + out.cwiseProduct(Point(spread, spread, 0.34f * h)) * random.range(0.3f, 0.72f);
    const float radius = spread * random.range(0.48f, 0.72f);
    if (tree.detail > 0.5f && i % 2 == 0)
      addTube(assembly, bark,
              {{fork + 0.3f * i / blobs * (top - fork), 0.45f * girth},
               {0.5f * (fork + blob) + Point(0, 0, -0.03f * h), 0.3f * girth},
               {blob, 0.08f * girth}},
              4);
    addFoliageBlob(assembly, tree, {blob, radius, middle, sprays, pictures, tint}, random);
  }
}

// Branches in whorls, each a card that droops outwards.
void addConifer(Assembly& assembly, const Foliage& foliage, const Tree& tree) {
  Random random(tree.seed);
  const Paint bark{assembly.palette().bark, barkColor(tree.species) * random.range(0.75f, 1.2f)};
  const float h = tree.height;
  const Point top = tree.root + (sway(0.02f * h, random) + Point(0, 0, h));
  addTube(assembly, bark,
          {{tree.root - Point(0, 0, 0.3f), 0.022f * h},
           {0.5f * (tree.root + top), 0.012f * h},
           {top, 0.001f * h}},
          6);
  const bool pine = tree.species == Species::kPine;
  const float bare = pine ? random.range(0.40f, 0.58f) : random.range(0.05f, 0.14f);
  const int whorls = tree.detail > 0.5f ? 19 : 10;
  const Color hue = Color(1.0f + 0.1f * random.bell(), 1.0f, 1.0f).max(0.5f);
  const Color tint = random.range(0.8f, 1.25f) * hue;
  for (int i = 0; i < whorls; ++i) {
    const float t = (static_cast<float>(i) + random.unit()) / static_cast<float>(whorls);
    const float level = bare + (1.0f - bare) * t;
    const float reach = h * (pine ? 0.24f * std::sqrt(std::max(0.05f, 1.0f - t * t)) : 0.22f * (1.03f - t)) *
                        random.range(0.8f, 1.15f);
    const int arms = tree.detail > 0.5f ? 8 : 5;
    for (int k = 0; k < arms; ++k) {
      const float angle = 2.0f * kPiFloat * (k + random.unit()) / arms;
      const Point out(std::cos(angle), std::sin(angle), 0.0f);
      const Point side(-out.y(), out.x(), 0.0f);
      const float droop = pine ? random.range(-0.15f, 0.35f) : random.range(-0.5f, -0.15f);
      const Point start = tree.root + level * (top - tree.root);
      const float length = reach * random.range(0.75f, 1.1f);
      const Point end = start + length * (out + Point(0, 0, droop));
      const Point half = 0.38f * length * (side + Point(0, 0, 0.35f * random.bell()));
      const Color color = tint * (0.60f + 0.45f * t + 0.12f * random.bell());
      const Leaves leaves{foliage.leaves[static_cast<int>(tree.species)][random.below(kVariants)],
                          color.max(0.3f)};
      const Point normal = (out + Point(0, 0, 0.9f)).normalized();
      addCard(assembly, {leaves.picture.material, leaves.tint},
              {{start - half, end - half, end + half, start + half}, leaves.picture.rect, even(normal)});
      if (tree.detail > 0.5f && k % 2 == 0)
        addSpray(assembly, leaves, {start + 0.75f * (end - start), normal, 0.8f * length + 0.2f, start},
                 random);
    }
  }
}

void addTree(Assembly& assembly, const Foliage& foliage, const Tree& tree) {
  const bool conifer = tree.species == Species::kSpruce || tree.species == Species::kPine;
  (conifer ? addConifer : addBroadLeaf)(assembly, foliage, tree);
}

void addBush(Assembly& assembly, const Foliage& foliage, const Point& root, std::uint32_t seed) {
  Random random(seed);
  const float radius = random.range(0.5f, 1.5f);
  const Species kinds[] = {Species::kOak, Species::kBirch, Species::kMaple, Species::kLime,
                           Species::kCopperBeech};
  const int kind = static_cast<int>(kinds[random.below(random.chance(0.15f) ? 5 : 4)]);
  const float shade = random.range(0.7f, 1.2f);
  const Color tint = Color(1.0f + 0.15f * random.bell(), 1.0f, 1.0f).max(0.5f) * shade;
  const int sprays = 17 + static_cast<int>(10.0f * radius);
  for (int i = 0; i < sprays; ++i) {
    Point way = direction(random);
    way.z() = std::abs(way.z());
    const Point place = root + radius * way.cwiseProduct(Point(1.0f, 1.0f, 0.9f)) * random.range(0.4f, 1.0f) +
                        Point(0, 0, 0.12f);
    const Leaves leaves{foliage.leaves[kind][random.below(kVariants)], tint * (0.6f + 0.45f * way.z())};
    addSpray(assembly, leaves,
             {place, (way + Point(0, 0, 0.3f)).normalized(), radius * random.range(0.55f, 0.85f), root},
             random);
  }
}

Species pick(Random& random, float grove) {
  const int roll = random.below(100);
  if (grove > 0.12f) return roll < 55 ? Species::kSpruce : roll < 85 ? Species::kPine : Species::kBirch;
  if (grove < -0.12f) return roll < 45 ? Species::kBirch : roll < 75 ? Species::kLime : Species::kMaple;
  return roll < 35   ? Species::kOak
         : roll < 60 ? Species::kMaple
         : roll < 78 ? Species::kLime
         : roll < 86 ? Species::kCopperBeech
                     : Species::kBirch;
}

float heightOf(Species species, Random& random) {
  const bool tall = species == Species::kSpruce || species == Species::kPine || species == Species::kBirch;
  return tall ? random.range(8.0f, 18.0f) : random.range(6.0f, 14.0f);
}

// A few sprays only, for trees that are seen from hundreds of metres.
void addFarTree(Assembly& assembly, const Foliage& foliage, const Tree& tree) {
  Random random(tree.seed);
  const bool conifer = tree.species == Species::kSpruce || tree.species == Species::kPine;
  const float shade = random.range(0.75f, 1.3f);
  const Color tint = leafHue(0.18f, random) * shade;
  const int sprays = conifer ? 4 : 5;
  for (int i = 0; i < sprays; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(sprays);
    const Point way = direction(random);
    const float reach = tree.height * (conifer ? 0.05f : 0.16f);
    const Point place =
        tree.root + Point(reach * way.x(), reach * way.y(), tree.height * (0.12f + 0.72f * t));
    const float size =
        tree.height * (conifer ? 0.62f * (1.08f - t) : 0.52f * (1.1f - 0.5f * std::abs(t - 0.4f)));
    const Point normal = (Point(way.x(), way.y(), 0.35f + 0.5f * t)).normalized();
    const Leaves leaves{foliage.leaves[static_cast<int>(tree.species)][random.below(kVariants)],
                        tint * (0.55f + 0.5f * t)};
    addSpray(assembly, leaves, {place, normal, size, tree.root + Point(0, 0, 0.5f * tree.height)}, random);
  }
}

}  // namespace

void addForest(Assembly& assembly, const Foliage& foliage) {
  Random random(521u);
  int planted = 0;
  for (int i = 0; i < 60000 && planted < 5600; ++i) {
    const float angle = random.range(0.0f, 2.0f * kPiFloat);
    const float reach = 1300.0f * random.unit();
    const float distance = 190.0f + reach * random.unit();
    const Eigen::Vector2d p(-10.0 + distance * std::cos(angle), 90.0 + 0.9 * distance * std::sin(angle));
    const float x = static_cast<float>(p.x());
    const float y = static_cast<float>(p.y());
    const float wood = fractal(x / 210.0f, y / 210.0f, 3, 522u);
    const float grove = noise(x / 90.0f, y / 90.0f, 523u);
    const std::uint32_t seed = random.bits();
    if (wood < 0.02f + 0.12f * random.bell() || std::abs(course().nearest(p).left) < 62.0) continue;
    Random own(seed);
    const Species species = pick(own, grove);
    const float height = 1.15f * heightOf(species, own);
    if (shadesOpenStretch(p, height)) continue;
    ++planted;
    addFarTree(assembly, foliage, {groundPoint(p) - Point(0, 0, 0.5f), species, height, 0.0f, seed});
  }
}

void addTrees(Assembly& assembly, const Foliage& foliage) {
  std::vector<Eigen::Vector2d> planted;
  Random random(401u);
  for (int i = 0; i < 14000 && planted.size() < 560; ++i) {
    const double along = random.unit() * course().length();
    const double side = random.chance(0.5f) ? 1.0 : -1.0;
    const float reach = 50.0f * random.unit();
    const TrackPlace place{along, side * (9.5f + reach * random.unit())};
    const Eigen::Vector2d p = course().point(place);
    const float x = static_cast<float>(p.x());
    const float y = static_cast<float>(p.y());
    const float density = smoothStep(-0.30f, 0.40f, noise(x / 34.0f, y / 34.0f, 402u)) + 0.12f;
    const std::uint32_t seed = random.bits();
    if (!random.chance(density) || !isFree(p, 1.8)) continue;
    bool crowded = false;
    for (const Eigen::Vector2d& other : planted) crowded = crowded || (other - p).squaredNorm() < 3.1 * 3.1;
    if (crowded) continue;
    Random own(seed);
    const Species species = pick(own, noise(x / 70.0f, y / 70.0f, 403u));
    // Taller in the middle of groves.
    const float height = heightOf(species, own) * (0.95f + 0.4f * density);
    if (shadesOpenStretch(p, height)) continue;
    planted.push_back(p);
    const double aside = std::abs(course().nearest(p).left);
    addTree(assembly, foliage, {groundPoint(p), species, height, aside < 24.0 ? 1.0f : 0.3f, seed});
  }
  for (int i = 0; i < 330; ++i) {
    const double along = random.unit() * course().length();
    const double side = random.chance(0.5f) ? 1.0 : -1.0;
    const TrackPlace place{along, side * random.range(9.0f, 30.0f)};
    const Eigen::Vector2d p = course().point(place);
    const std::uint32_t seed = random.bits();
    if (isFree(p, 0.6)) addBush(assembly, foliage, groundPoint(p), seed);
  }
}

}  // namespace sunlit::scene::race_track
