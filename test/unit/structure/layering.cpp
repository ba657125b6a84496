// The rules of the house: who may include whom, which library is used where, how long files and
// functions may be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "unit/structure/function_scan.h"

namespace {

namespace fs = std::filesystem;
using Modules = std::set<std::string>;
using sunlit::FunctionScan;
using sunlit::FunctionShape;

const std::map<std::string, Modules> kMayInclude = {
    {"quantity", {}},
    {"astronomy", {"quantity"}},
    {"sky", {"quantity"}},
    {"image", {"quantity"}},
    {"scene", {"image", "quantity"}},
    {"path", {"image", "quantity"}},
    {"light", {"scene", "sky", "image", "quantity"}},
    {"render", {"light", "scene", "sky", "image", "quantity"}},
    {"studio", {"render", "light", "scene", "path", "sky", "astronomy", "image", "quantity"}},
    {"evaluate", {"image", "quantity"}},
    {"tools",
     {"astronomy", "sky", "image", "scene", "path", "light", "render", "studio", "evaluate", "quantity"}},
    {"ros",
     {"astronomy", "sky", "image", "scene", "path", "light", "render", "studio", "evaluate", "quantity"}},
};

struct LibraryRule {
  std::regex include;
  Modules modules;
};

std::vector<LibraryRule> libraryRules() {
  const std::regex ros(
      R"((ros|rosbag|rospack|pluginlib|class_loader|tf2|tf2_[a-z]+|eigen_conversions|cv_bridge|image_transport|message_filters|nodelet|)"
      R"(diagnostic_updater|xmlrpcpp|std_srvs|[a-z]+_msgs)/.*|sunlit/[A-Z]\w*\.h|XmlRpc.*)");  // and our own
                                                                                               // messages
  return {
      {ros, {"ros"}},
      {std::regex("opencv2/.*"), {"image", "evaluate", "ros"}},
      {std::regex("erfam?\\.h"), {"astronomy"}},
      {std::regex("(GL|EGL|GLES[23]?|KHR|OpenGL)/.*"), {"render"}},
      {std::regex("embree[34]/.*"), {"light"}},
      {std::regex("xxhash\\.h"), {"image"}},
      {std::regex("(sdf|assimp|nlohmann|urdf_[a-z]+)/.*|tinyxml2?.h"), {"scene"}},
      {std::regex("boost/program_options.*"), {"studio"}},
      {std::regex("yaml-cpp/.*"), {"image", "ros"}},
      {std::regex("tbb/.*"), {"sky", "image", "scene", "light", "render", "evaluate", "ros"}},
  };
}

struct SourceFile {
  fs::path path;
  std::string module;
  std::vector<std::string> lines;
};

std::vector<SourceFile> sources() {
  std::vector<SourceFile> files;
  for (const char* root : {"include/sunlit", "src"}) {
    const fs::path base = fs::path(SUNLIT_SOURCE_DIR) / root;
    for (const auto& entry : fs::recursive_directory_iterator(base)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      SourceFile file{entry.path(), entry.path().lexically_relative(base).begin()->string(), {}};
      std::ifstream stream(entry.path());
      for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
      files.push_back(std::move(file));
    }
  }
  return files;
}

std::vector<std::string> includesOf(const SourceFile& file) {
  static const std::regex directive(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  std::vector<std::string> includes;
  for (const std::string& line : file.lines) {
    std::smatch match;
    if (std::regex_match(line, match, directive)) includes.push_back(match[1]);
  }
  return includes;
}

TEST(Structure, EveryFileBelongsToAModule) {
  ASSERT_GT(sources().size(), 20u);
  for (const SourceFile& file : sources()) EXPECT_EQ(kMayInclude.count(file.module), 1u) << file.path;
}

/// A file of the part `own` may include, of what `part` matches, only what its own and `allowed` parts hold.
void expectOnly(const SourceFile& file, const std::string& own, const Modules& allowed,
                const std::regex& part) {
  for (const std::string& include : includesOf(file)) {
    std::smatch match;
    if (!std::regex_match(include, match, part)) continue;
    EXPECT_TRUE(match[1] == own || allowed.count(match[1]) == 1) << file.path << " includes " << include;
  }
}

TEST(Structure, DependenciesPointOneWay) {
  // Private headers too, which are named from src/.
  std::string modules;
  for (const auto& entry : kMayInclude) modules += (modules.empty() ? "" : "|") + entry.first;
  const std::regex ours("(?:sunlit/)?(" + modules + ")/.*");
  for (const SourceFile& file : sources()) expectOnly(file, file.module, kMayInclude.at(file.module), ours);
}

// Of the rooms of a module: folders below its own, or below those. What stands beside them puts them
// together.
const std::map<std::string, Modules> kRoomsOfLight = {
    {"geometry", {}},
    {"patches", {}},
    {"shading", {"geometry"}},
    {"lamps", {}},
    {"bake/samples", {"geometry", "patches", "shading"}},
    {"bake/gather", {"bake/samples", "geometry", "lamps", "patches", "shading"}},
    {"bake/cache", {"bake/samples"}},
    {"picture/outlook", {"bake/samples", "patches"}},
    {"picture/table", {"picture/outlook", "shading"}},
    {"picture/disc", {"geometry", "patches", "picture/table", "shading"}},
    {"picture/lamps", {"geometry", "lamps", "patches", "shading"}},
    {"picture/mirror", {"bake/samples", "geometry", "patches", "picture/outlook", "shading"}},
    {"picture/gather", {"geometry", "patches", "picture/outlook"}},
    {"picture/bodies",
     {"bake/samples", "geometry", "lamps", "patches", "picture/disc", "picture/outlook", "shading"}},
    {"picture/sky", {"bake/samples", "geometry", "patches", "picture/table"}},
    {"picture/fog", {"geometry", "lamps", "picture/sky"}},
    {"picture",
     {"bake/samples", "geometry", "lamps", "patches", "picture/bodies", "picture/disc", "picture/fog",
      "picture/gather", "picture/lamps", "picture/mirror", "picture/outlook", "picture/sky", "picture/table",
      "shading"}},
    {"reference", {"bake/samples", "geometry", "lamps", "patches", "picture/fog", "picture/sky", "shading"}},
};

const std::map<std::string, Modules> kRoomsOfEvaluate = {
    {"comparisons", {"files", "localise", "verify"}},
    {"data_sets", {}},
    {"atlas", {"features", "files", "localise", "verify"}},
    {"features", {}},
    {"differences", {"features"}},
    {"files", {"differences"}},
    {"run", {"comparisons", "differences", "features", "files", "localise", "verify"}},
    {"trajectory", {"files"}},
    {"places", {"features", "files"}},
    {"verify", {"differences", "features", "files"}},
    {"localise", {"differences", "features", "files", "places"}},
};

/// The room, one of `rooms`, that a file below its module's folder lies in: the innermost one. Empty: it
/// stands beside them.
std::string roomOf(const fs::path& below_module, const std::map<std::string, Modules>& rooms) {
  for (fs::path folder = below_module.parent_path(); !folder.empty(); folder = folder.parent_path())
    if (rooms.count(folder.generic_string()) == 1) return folder.generic_string();
  return "";
}

/// Of private and public headers and sources; `least` files at least lie in rooms.
void expectRoomsToPointOneWay(const std::string& module, const std::map<std::string, Modules>& rooms,
                              std::size_t least) {
  const std::regex of_module("(?:src/|include/)?(?:sunlit/)?" + module + "/(.*)");
  std::size_t seen = 0;
  for (const SourceFile& file : sources()) {
    const std::string path = file.path.lexically_relative(fs::path(SUNLIT_SOURCE_DIR)).generic_string();
    std::smatch below;
    if (!std::regex_match(path, below, of_module) || !fs::path(below[1].str()).has_parent_path()) continue;
    const std::string own = roomOf(below[1].str(), rooms);
    ++seen;
    ASSERT_FALSE(own.empty()) << file.path << " lies in no room";
    for (const std::string& include : includesOf(file)) {
      if (!std::regex_match(include, below, of_module)) continue;
      const std::string room = roomOf(below[1].str(), rooms);
      EXPECT_TRUE(room.empty() || room == own || rooms.at(own).count(room) == 1)
          << file.path << " includes " << include;
    }
  }
  EXPECT_GE(seen, least);
}

TEST(Structure, RoomsOfLightPointOneWay) {
  expectRoomsToPointOneWay("light", kRoomsOfLight, 140);
}

/// Headers that rooms of light share lie in the lowest of them, so that none hides from the rule above.
TEST(Structure, NoHeaderStandsBesideTheRoomsOfLight) {
  const fs::path beside = fs::path(SUNLIT_SOURCE_DIR) / "src/light";
  for (const SourceFile& file : sources())
    EXPECT_TRUE(file.path.parent_path() != beside || file.path.extension() != ".h") << file.path;
}

/// Those that only light itself would include lie in its rooms.
TEST(Structure, PublicHeadersOfLightAreThoseThatOthersInclude) {
  std::set<std::string> included, headers;
  for (const SourceFile& file : sources()) {
    const std::string path = file.path.lexically_relative(fs::path(SUNLIT_SOURCE_DIR)).generic_string();
    const bool public_header = path.rfind("include/sunlit/light/", 0) == 0;
    if (public_header) headers.insert(path.substr(8));
    if (!public_header && file.module == "light") continue;
    for (const std::string& include : includesOf(file)) included.insert(include);
  }
  EXPECT_GT(headers.size(), 8u);
  for (const std::string& header : headers) EXPECT_EQ(included.count(header), 1u) << header;
}

TEST(Structure, RoomsOfEvaluatePointOneWay) {
  expectRoomsToPointOneWay("evaluate", kRoomsOfEvaluate, 40);
}

TEST(Structure, LibrariesStayInTheirModules) {
  const auto rules = libraryRules();
  for (const SourceFile& file : sources()) {
    for (const std::string& include : includesOf(file)) {
      for (const LibraryRule& rule : rules) {
        if (!std::regex_match(include, rule.include)) continue;
        EXPECT_EQ(rule.modules.count(file.module), 1u) << file.path << " includes " << include;
      }
    }
  }
}

// What may go away with a library must not have spread.
TEST(Structure, OneFileKnowsEachWayToOpenGl) {
  const std::map<std::string, std::regex> ways = {{"osmesa_context.cpp", std::regex("GL/osmesa.h")},
                                                  {"egl_context.cpp", std::regex("EGL/.*")}};
  for (const auto& [name, include] : ways) {
    Modules files;
    for (const SourceFile& file : sources()) {
      for (const std::string& included : includesOf(file)) {
        if (std::regex_match(included, include)) files.insert(file.path.filename().string());
      }
    }
    EXPECT_EQ(files, Modules{name});
  }
}

/// Tables of published constants are exempt: a file that is one says so in its name.
bool isTable(const SourceFile& file) {
  return file.path.stem().string().find("table") != std::string::npos;
}

TEST(Structure, FilesAreShort) {
  for (const SourceFile& file : sources()) {
    if (isTable(file)) continue;
    const std::size_t limit = file.path.extension() == ".h" ? 200 : 400;
    EXPECT_LE(file.lines.size(), limit) << file.path;
  }
}

/// Hot loops tell the compiler by their parameters alone that arrays do not overlap. One list is OpenCV's to
/// make, one names what must outlive the object, one by one.
bool mayTakeMore(const FunctionShape& function) {
  static const std::regex hot_loop("SUNLIT_[A-Z_]*CLONES");
  static const std::set<std::string> others = {"Surf::detectAndCompute", "RootSiftWorker::detectAndCompute",
                                               "detectAndCompute"};
  return std::regex_search(function.before, hot_loop) || others.count(function.name) == 1;
}

TEST(Structure, FunctionsAreShortAndTakeFewParameters) {
  std::size_t seen = 0;
  for (const SourceFile& file : sources()) {
    if (isTable(file)) continue;
    std::string text;
    for (const std::string& line : file.lines) text += line + "\n";
    const FunctionScan scan(text);
    for (const FunctionShape& function : scan.functions()) {
      ++seen;
      const std::string where =
          file.path.string() + ":" + std::to_string(function.first_line) + ": " + function.name;
      EXPECT_LE(function.lines, 50u) << where;
      EXPECT_TRUE(function.parameters <= 4 || mayTakeMore(function))
          << where << " takes " << function.parameters << ": more than four belong in a struct";
    }
  }
  EXPECT_GT(seen, 1500u);
}

TEST(Structure, NamesOfTestsAreOfOneCase) {
  const std::regex begins(R"(^(TYPED_)?TEST(_F|_P)?\((\w+), *(\w+))");
  std::size_t seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SUNLIT_SOURCE_DIR) / "test")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream stream(entry.path());
    for (std::string line; std::getline(stream, line);) {
      std::smatch names;
      if (!std::regex_search(line, names, begins)) continue;
      ++seen;
      for (const int part : {3, 4})
        EXPECT_TRUE(std::isupper(static_cast<unsigned char>(*names[part].first)))
            << entry.path() << ": " << line;
    }
  }
  EXPECT_GT(seen, 500u);
}

}  // namespace
