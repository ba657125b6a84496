// How rasterizers start, or say that they can't; the same bits whoever else draws, and however many threads
// drivers use. Drivers read their environment once, so each case is a process of its own.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <future>

#include "rasterizer_scenes.h"
#include "support/message_of.h"

namespace sunlit::test {
namespace {

using render::RasterizerKind;

scene::Scene fence() {
  scene::Scene scene;
  scene::Texture texture{"planks", 16, 16, {}};
  for (int i = 0; i < 16 * 16; ++i)
    texture.rgba.own().insert(texture.rgba.own().end(),
                              {90, 90, 90, static_cast<std::uint8_t>(16 * (i * 7 % 16))});
  scene.textures.push_back(texture);
  addGround(&scene, addMaterial(&scene, {0.4f, 0.4f, 0.4f}), 200.0f);
  const int planks = addMaterial(&scene, {0.8f, 0.8f, 0.8f});
  scene.materials[1].base_texture = 0;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  for (int i = 0; i < 60; ++i)
    addBlock(&scene, i % 2 == 0 ? planks : 0,
             {3.0f + static_cast<float>(i), static_cast<float>(i % 9) - 4.0f, 0.0f}, {0.7f, 0.6f, 1.3f});
  return scene;
}

/// A picture of the fence in one number (FNV-1a).
std::uint64_t picture(RasterizerKind kind) {
  const auto geometry = std::make_shared<const light::Geometry>(shared(fence()));
  const render::TexturePyramids pyramids(*geometry->scene);
  const auto rasterizer = render::makeRasterizer(kind, {geometry, pyramids, 0.0});
  std::vector<render::Sample> samples;
  std::uint64_t hash = 14695981039346656037u;
  for (const double y : {-2.0, 0.3}) {
    rasterizer->draw(viewFrom(lookingAt({0.0, y, 1.4}, {20.0, 0.0, 0.5}), 320, 240), nullptr, &samples);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(samples.data());
    for (std::size_t i = 0; i < samples.size() * sizeof(samples[0]); ++i)
      hash = (hash ^ bytes[i]) * 1099511628211u;
  }
  return hash;
}

/// What this program prints as a child with more in its environment, see the case below; with its exit
/// status.
std::string child(RasterizerKind kind, const std::string& environment) {
  std::array<char, 4096> self{};
  if (::readlink("/proc/self/exe", self.data(), self.size() - 1) < 0) return "no /proc/self/exe";
  const std::string command =
      environment + " SUNLIT_TEST_RASTERIZER=" + render::nameOf(kind) + " '" + self.data() +
      "' --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_Child*' 2>/dev/null";
  std::string text;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (!pipe) return "no shell";
  std::array<char, 4096> part;
  while (std::fgets(part.data(), part.size(), pipe)) {
    const std::string line = part.data();
    if (line.rfind("child: ", 0) == 0) text += line.substr(7);
  }
  const int status = ::pclose(pipe);
  return text + (WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "" : "ended badly");
}

RasterizerKind named(const std::string& name) {
  render::RenderOptions options;
  fieldOf(fieldsOf(options), "rasterizer").setText(name, "--rasterizer");
  return options.rasterizer;
}

TEST(RasterizerProcess, DISABLED_Child) {
  const char* const name = std::getenv("SUNLIT_TEST_RASTERIZER");
  ASSERT_TRUE(name);
  try {
    std::printf("\nchild: %016llx\n", static_cast<unsigned long long>(picture(named(name))));
  } catch (const std::runtime_error& error) {
    std::printf("\nchild: %s\n", error.what());
  }
}

class Device : public EachRasterizer {};

TEST_P(Device, GivesTheSameBitsInEveryRunAndForAnyNumberOfItsThreads) {
  const std::string first = child(GetParam(), "LP_NUM_THREADS=0");
  EXPECT_EQ(first.size(), 17u) << first;
  for (const char* environment : {"LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2", ""})
    EXPECT_EQ(child(GetParam(), environment), first) << environment;
}

TEST_P(Device, ServesManyRasterizersOfManyThreadsAtOnce) {
  const std::uint64_t alone = picture(GetParam());
  std::vector<std::future<std::uint64_t>> meanwhile;
  for (int i = 0; i < 4; ++i) meanwhile.push_back(std::async(std::launch::async, picture, GetParam()));
  for (auto& one : meanwhile) EXPECT_EQ(one.get(), alone);
}

TEST_P(Device, IsNamedByTheRenderer) {
  render::RenderOptions options = smallCamera();
  options.rasterizer = GetParam();
  const render::Renderer renderer(shared(fence()), options);
  EXPECT_EQ(renderer.rasterizer().rfind(render::nameOf(GetParam()), 0), 0u) << renderer.rasterizer();
}
SUNLIT_INSTANTIATE_FOR_ALL(Device);

/// Whether this build has it.
bool has(RasterizerKind rasterizer) {
  const auto built = render::builtRasterizers();
  return std::find(built.begin(), built.end(), rasterizer) != built.end();
}

/// One line that says which, why and what else there is.
void expectRefusal(const std::string& line, const std::string& name) {
  EXPECT_EQ(line.rfind("rasterizer " + name + " cannot start: ", 0), 0u) << line;
  EXPECT_NE(line.find("builtin"), std::string::npos) << line;
  EXPECT_EQ(line.find("; those that can: " + name), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), line.size() - 1) << line;
}

TEST(RasterizerThatCannotStart, IsOneLineThatNamesTheOthers) {
  if (has(RasterizerKind::kOsmesa))
    expectRefusal(child(RasterizerKind::kOsmesa, "MESA_GL_VERSION_OVERRIDE=3.3"), "osmesa");
  if (has(RasterizerKind::kEgl))
    expectRefusal(child(RasterizerKind::kEgl, "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere.json"), "egl");
}

TEST(RasterizerThatWasLeftOut, IsOneLineThatNamesTheOthers) {
  for (const RasterizerKind rasterizer : {RasterizerKind::kOsmesa, RasterizerKind::kEgl}) {
    if (has(rasterizer)) continue;
    const std::string line = messageOf<std::runtime_error>([&] { picture(rasterizer); });
    expectRefusal(line + "\n", render::nameOf(rasterizer));
    EXPECT_NE(line.find("this build was made without it"), std::string::npos) << line;
  }
}

TEST(Rasterizer, IsChosenByName) {
  for (const RasterizerKind rasterizer :
       {RasterizerKind::kOsmesa, RasterizerKind::kEgl, RasterizerKind::kBuiltin})
    EXPECT_EQ(named(render::nameOf(rasterizer)), rasterizer);
  const std::string refused = messageOf([] { named("Mesa"); });
  for (const char* part : {"--rasterizer", "Mesa", "osmesa", "egl", "builtin"})
    EXPECT_NE(refused.find(part), std::string::npos) << refused;
  EXPECT_EQ(render::RenderOptions().rasterizer, render::builtRasterizers().front());
}

}  // namespace
}  // namespace sunlit::test
