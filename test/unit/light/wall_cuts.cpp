// Cells of the ground that sheets and thin walls go through.
#include "light/bake/samples/wall_cuts.h"

#include <gtest/gtest.h>

#include <random>

#include "light/bake/samples/sheet_sides.h"
#include "paper_scene.h"

namespace sunlit::light {
namespace {

/// Ground of one or two triangles, on which a sheet stands.
struct Ground {
  explicit Ground(std::vector<Eigen::Vector2f> corners) {
    for (const Eigen::Vector2f& corner : corners) {
      MeshNode node;
      node.position = Eigen::Vector3f(corner.x(), corner.y(), 0.0f);
      node.normal = Eigen::Vector3f::UnitZ();
      node.face.setZero();
      nodes.push_back(node);
    }
  }
  void addSheet(const Eigen::Vector2f& from, const Eigen::Vector2f& to) {
    const Eigen::Vector2f way = to - from;
    addPatch(&scene, 0, {from.x(), from.y(), 0.0f}, {way.x(), way.y(), 0.0f}, {0.0f, 0.0f, 2.0f});
  }
  /// Calls work(scene).
  template <typename Work>
  void with(const Work& work) const {
    scene::Scene whole = scene;
    whole.materials = {paint(0.5f)};
    const auto geometry = std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(whole));
    const BakeRays rays(geometry);
    const std::vector<TriangleTraits> traits = triangleTraits(*geometry, rays);
    work(BakeScene{*geometry, rays, traits});
  }
  std::vector<std::uint32_t> cut() {
    std::vector<std::uint32_t> touched;
    with([&](const BakeScene& with_rays) { touched = WallCuts(with_rays, &mesh, &nodes).cut(); });
    return touched;
  }
  Eigen::Vector2f at(std::uint32_t node) const { return nodes[node].position.head<2>(); }

  scene::Scene scene;
  LightMesh mesh;
  std::vector<MeshNode> nodes;
};

/// Of random places in the first triangle, the most that what locate() finds lies off the place, and how many
/// have a node whose `side` is not theirs.
struct Found {
  float farthest_off_m = 0.0f;
  int on_the_wrong_side = 0;
};

template <typename Side>
Found locateAll(const Ground& ground, const Side& side) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform;
  Found found;
  for (int i = 0; i < 2000; ++i) {
    const float a = uniform(random), b = uniform(random);
    const std::array<float, 3> within = {1.0f - std::max(a, b), std::abs(a - b), std::min(a, b)};
    Eigen::Vector2f place = Eigen::Vector2f::Zero(), there = place;
    for (std::uint32_t k = 0; k < 3; ++k) place += within[k] * ground.at(k);
    const LightMesh::Place located = ground.mesh.locate(0, within);
    for (std::size_t k = 0; k < 3; ++k) {
      there += located.weight[k] * ground.at(located.node[k]);
      // A node on the wall is on the side that it gathers from.
      const MeshNode& node = ground.nodes[located.node[k]];
      Eigen::Vector2f from = node.receiver().origins[0].head<2>();
      if (side(place) != side(from)) ++found.on_the_wrong_side;
    }
    found.farthest_off_m = std::max(found.farthest_off_m, (there - place).norm());
  }
  return found;
}

void pullAll(Ground* ground) {
  for (const LightMesh::Cell& cell : ground->mesh.cells) {
    if (cell.inner()) continue;
    const Eigen::Vector3f middle = middleOf(cell, ground->nodes);
    for (const std::uint32_t n : cell.corner)
      ground->nodes[n].pullTowards(middle, (middle - ground->nodes[n].position).norm());
  }
}

TEST(LightMesh, FindsPlacesInCellsThatAreDividedAnywhere) {
  Ground ground({{0.0f, 0.0f}, {4.0f, 0.0f}, {0.0f, 2.0f}, {3.0f, 0.0f}, {0.0f, 0.4f}});
  // 3 lies on the edge from 0 to 1, at three quarters of it; 4 on that from 2 to 0, at four fifths.
  ground.mesh.cells.push_back(LightMesh::Cell::divided(1, 0, 0.75f));
  ground.mesh.cells.push_back(LightMesh::Cell::divided(3, 2, 0.8f));
  ground.mesh.cells.push_back({{3, 1, 2}});
  ground.mesh.cells.push_back({{2, 4, 3}});
  ground.mesh.cells.push_back({{4, 0, 3}});
  EXPECT_EQ(ground.mesh.locate(0, {0.1f, 0.8f, 0.1f}).node, (std::array<std::uint32_t, 3>{3, 1, 2}));
  EXPECT_LT(locateAll(ground, [](const Eigen::Vector2f&) { return true; }).farthest_off_m, 1e-5f);
}

TEST(WallCuts, PartWhatLiesOnBothSidesOfASheet) {
  // It parts any one of the corners from the others, or ends within the triangle.
  for (const float turned_rad : {0.1f, 2.2f, 4.3f}) {
    Ground ground({{-0.1f, -0.06f}, {0.12f, -0.05f}, {0.01f, 0.13f}});
    ground.mesh.cells.push_back({{0, 1, 2}});
    const Eigen::Vector2f along(std::cos(turned_rad), std::sin(turned_rad)), across(-along.y(), along.x());
    const auto side = [&](const Eigen::Vector2f& place) { return across.dot(place) > 0.01f; };
    ground.addSheet(0.01f * across - along, 0.01f * across + along);
    const std::vector<std::uint32_t> touched = ground.cut();
    EXPECT_EQ(touched.size(), 7u) << "three corners, and two nodes on each of two edges";
    pullAll(&ground);
    const Found found = locateAll(ground, side);
    EXPECT_EQ(found.on_the_wrong_side, 0) << turned_rad;
    // Rays meet the sheet within 1e-6 of an edge.
    EXPECT_LT(found.farthest_off_m, 1e-5f) << turned_rad;
  }
}

TEST(WallCuts, FollowTwoSheetsThatMeetInACell) {
  Ground ground({{-0.1f, -0.06f}, {0.12f, -0.05f}, {0.01f, 0.13f}});
  ground.mesh.cells.push_back({{0, 1, 2}});
  const Eigen::Vector2f corner(0.01f, 0.02f);
  ground.addSheet(corner, {-0.5f, 0.22f});
  ground.addSheet(corner, {0.5f, 0.22f});
  ground.cut();
  ground.with([&](const BakeScene& scene) { SheetSides(scene, &ground.mesh, &ground.nodes).separate(); });
  pullAll(&ground);
  const Found found = locateAll(ground, [&](const Eigen::Vector2f& place) {
    const Eigen::Vector2f way = place - corner;
    return way.y() > (0.2f / 0.51f) * -way.x() && way.y() > (0.2f / 0.49f) * way.x();
  });
  EXPECT_EQ(found.on_the_wrong_side, 0);
  EXPECT_LT(found.farthest_off_m, 1e-5f);
}

TEST(WallCuts, LeaveCellsBesideAWallAsTheyAre) {
  Ground ground({{0.1f, 0.0f}, {0.3f, 0.0f}, {0.1f, 0.2f}});
  ground.mesh.cells.push_back({{0, 1, 2}});
  ground.addSheet({0.0f, -1.0f}, {0.0f, 1.0f});
  EXPECT_TRUE(ground.cut().empty());
  EXPECT_EQ(ground.mesh.cells.size(), 1u);
  EXPECT_EQ(ground.nodes.size(), 3u);
}

TEST(WallCuts, PartTheSidesOfAWallOutdoorsButNotThoseOfASign) {
  // The sky that each place sees, share by cosine and that times its mean direction.
  const auto cut = [](const Eigen::Vector4f& before, const Eigen::Vector4f& behind) {
    Ground ground({{-0.1f, -0.05f}, {0.1f, -0.05f}, {0.0f, 0.1f}});
    ground.mesh.cells.push_back({{0, 1, 2}});
    ground.addSheet({-1.0f, 0.0f}, {1.0f, 0.0f});
    for (MeshNode& node : ground.nodes) node.open = node.position.y() < 0.0f ? before : behind;
    return !ground.cut().empty();
  };
  EXPECT_TRUE(cut({0.0f, -0.22f, 0.3f, 0.5f}, {0.0f, 0.22f, 0.3f, 0.5f}));
  EXPECT_FALSE(cut({0.0f, -0.1f, 0.55f, 0.8f}, {0.0f, 0.1f, 0.55f, 0.8f}));
}

TEST(SheetSides, LetNodesThatASheetStandsOnLookAroundFromBesideIt) {
  for (const float turned_rad : {0.0f, 0.8f, 1.6f, 2.4f}) {
    Ground ground({{0.0f, 0.0f}, {0.3f, -0.4f}});
    const Eigen::Vector2f along(std::cos(turned_rad), std::sin(turned_rad));
    ground.addSheet(-along, along);
    ground.with([&](const BakeScene& scene) { stepOffSheets(scene, 0, &ground.nodes); });
    const Eigen::Vector2f from = ground.nodes[0].receiver().origins[0].head<2>();
    EXPECT_GT(std::abs(along.x() * from.y() - along.y() * from.x()), 4e-3f) << turned_rad;
    EXPECT_EQ(ground.nodes[1].receiver().origins[0], ground.nodes[1].position);
  }
}

TEST(SheetSides, GiveEachSideItsNodeWhereASheetStandsOnThem) {
  // Two triangles, and the sheet along the edge between them.
  Ground ground({{0.0f, 0.0f}, {0.0f, 0.5f}, {-0.4f, 0.2f}, {0.4f, 0.2f}});
  ground.mesh.cells.push_back({{0, 1, 2}});
  ground.mesh.cells.push_back({{1, 0, 3}});
  ground.addSheet({0.0f, -1.0f}, {0.0f, 1.0f});
  std::vector<SheetSides::Side> sides;
  ground.with(
      [&](const BakeScene& scene) { sides = SheetSides(scene, &ground.mesh, &ground.nodes).separate(); });
  EXPECT_EQ(ground.nodes.size(), 6u);
  EXPECT_EQ(sides.size(), 4u);
  for (const std::uint32_t n : ground.mesh.cells[0].corner)
    for (const std::uint32_t other : ground.mesh.cells[1].corner) EXPECT_NE(n, other);
  EXPECT_EQ(ground.mesh.cells[0].corner[2], 2u) << "whose cells are all on one side";
}

TEST(SheetSides, AreApartWhereTwoSheetsMeetOnANode) {
  // Cells have others right opposite: rays between these may slip through between the sheets.
  const Eigen::Vector2f x(0.1875f, 0.0f), y(0.0f, 0.16875f);
  for (int i = 0; i < 20; ++i) {
    const float far = static_cast<float>(i);
    const Eigen::Vector2f corner(-3.0f - 0.1f * far, -2.7f - 0.07f * far);
    std::vector<Eigen::Vector2f> corners = {corner};
    for (const Eigen::Vector2f& to : {x, Eigen::Vector2f(0.5f * (x + y)), y, Eigen::Vector2f(0.5f * (y - x))})
      corners.push_back(corner + to);
    for (std::size_t k = 1; k <= 4; ++k) corners.push_back(2.0f * corner - corners[k]);
    Ground ground(corners);
    for (std::uint32_t k = 1; k <= 8; ++k) ground.mesh.cells.push_back({{0, k, k % 8 + 1}});
    ground.addSheet(corner, {3.0f, corner.y()});
    ground.addSheet({corner.x(), 2.7f}, corner);
    ground.with([&](const BakeScene& scene) { SheetSides(scene, &ground.mesh, &ground.nodes).separate(); });
    for (std::size_t inside = 0; inside < 2; ++inside)
      for (std::size_t outside = 2; outside < 8; ++outside)
        EXPECT_NE(ground.mesh.cells[inside].corner[0], ground.mesh.cells[outside].corner[0]) << i;
  }
}

TEST(SheetSides, LeaveNodesThatASheetEndsAt) {
  // All around it, one gets past the sheet.
  Ground ground({{0.0f, 0.0f}, {0.4f, 0.0f}, {0.0f, 0.4f}, {-0.4f, 0.0f}, {0.0f, -0.4f}});
  for (std::uint32_t k = 1; k <= 4; ++k) ground.mesh.cells.push_back({{0, k, k % 4 + 1}});
  ground.addSheet({0.0f, 0.0f}, {0.7f, 0.7f});
  ground.with([&](const BakeScene& scene) {
    EXPECT_TRUE(SheetSides(scene, &ground.mesh, &ground.nodes).separate().empty());
  });
}

}  // namespace
}  // namespace sunlit::light
