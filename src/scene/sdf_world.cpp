#include "scene/sdf_world.h"

#include <console_bridge/console.h>

#include <Eigen/Geometry>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/scene_builder.h"
#include "scene/sdf_includes.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_visuals.h"

namespace sunlit::scene {
namespace {

/// Keeps what libsdformat would print, for as long as it lives. What it cannot read it tries as a robot
/// description; the complaints about that are of no use to anyone and go nowhere.
class SdfConsole {
 public:
  SdfConsole() : before_(stream().GetStream()) {
    stream().SetStream(&text_);
    console_bridge::noOutputHandler();
  }
  ~SdfConsole() {
    stream().SetStream(before_);
    console_bridge::restorePreviousOutputHandler();
  }
  SdfConsole(const SdfConsole&) = delete;
  SdfConsole& operator=(const SdfConsole&) = delete;

  std::string text() const { return text_.str(); }

 private:
  static sdf::Console::ConsoleStream& stream() { return sdf::Console::Instance()->GetMsgStream(); }
  std::ostringstream text_;
  std::ostream* before_;
};

/// What libsdformat printed, line by line, without colours and places in its own source.
std::vector<std::string> printedLines(const std::string& text) {
  const std::regex colors("\x1b\\[[0-9;]*m");
  const std::regex prefix("^[A-Za-z]+ \\[[^\\]]*\\] *");
  std::vector<std::string> printed;
  std::istringstream lines(std::regex_replace(text, colors, ""));
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(line, prefix, "");
    if (!line.empty()) printed.push_back(line);
  }
  return printed;
}

/// One line about the first of `errors`, which for broken XML says less than what was printed.
[[noreturn]] void fail(const std::string& file, const sdf::Error& error,
                       const std::vector<std::string>& printed) {
  const std::regex broken_xml("Error parsing XML in file \\[(.*)\\]: Error=(\\S+) .*Line number=([0-9]+).*");
  std::smatch match;
  for (const std::string& line : printed) {
    if (!std::regex_match(line, match, broken_xml)) continue;
    throw std::runtime_error(match[1].str() + ":" + match[3].str() + ": the XML is broken here (" +
                             match[2].str() + ")");
  }
  std::ostringstream text;
  text << error.FilePath().value_or(file);
  if (error.LineNumber()) text << ":" << *error.LineNumber();
  text << ": " << error.Message();
  if (!printed.empty()) text << " (" << printed.front() << ")";
  throw std::runtime_error(text.str());
}

[[noreturn]] void failMissing(const std::string& file, const sdf::Error& error,
                              const std::map<std::string, std::string>& missing) {
  std::ostringstream text;
  text << error.FilePath().value_or(file);
  if (error.LineNumber()) text << ":" << *error.LineNumber();
  for (const auto& [uri, places] : missing)
    text << ": there is no " << uri << "; it was looked for as " << places;
  throw std::runtime_error(text.str());
}

/// libsdformat takes a file without this element for a robot description.
void checkIsSdf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + ": cannot open this file");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (text.find("<sdf") == std::string::npos) {
    throw std::runtime_error(file + ":1: there is no <sdf> element in this file");
  }
}

void addWorld(const sdf::World& world, SdfVisuals& visuals, SceneBuilder& builder) {
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    visuals.addModel(*world.ModelByIndex(i), Eigen::Isometry3d::Identity(), "");
  }
  if (world.LightCount() > 0) builder.count("lights of the world were not read", world.LightCount());
  if (world.ActorCount() > 0) builder.count("actors of the world were not read", world.ActorCount());
}

/// Reads `file`, sharing what it includes more than once; what cannot be shared is left to libsdformat alone,
/// whose errors are then the true ones.
void read(const std::string& file, SdfIncludes& includes, sdf::Root& root, SceneBuilder& builder) {
  const SdfConsole console;
  sdf::Errors errors = root.Load(file, includes.sharingConfig());
  std::vector<std::string> printed = printedLines(console.text());
  if (!errors.empty()) {
    const SdfConsole plain_console;
    includes.forgetInstances();
    root = sdf::Root();
    errors = root.Load(file, includes.plainConfig());
    printed = printedLines(plain_console.text());
  }
  if (!errors.empty() && !includes.missing().empty()) failMissing(file, errors.front(), includes.missing());
  if (!errors.empty()) fail(file, errors.front(), printed);
  for (const std::string& line : printed) builder.count("× libsdformat: " + line);
}

}  // namespace

Scene loadSdf(const std::string& file, const ResourceFinder& finder) {
  checkIsSdf(file);
  SdfIncludes includes(file, finder);
  SceneBuilder builder(file);
  sdf::Root root;
  read(file, includes, root, builder);
  SdfVisuals visuals(file, finder, builder);
  for (std::uint64_t i = 0; i < root.WorldCount(); ++i) addWorld(*root.WorldByIndex(i), visuals, builder);
  if (root.Model() != nullptr) visuals.addModel(*root.Model(), Eigen::Isometry3d::Identity(), "");
  for (const SdfIncludes::Instance& instance : includes.instances()) {
    visuals.addModelAt(*instance.model, toEigen(instance.pose), instance.name);
  }
  Scene scene = builder.finish();
  if (scene.meshes.empty()) throw std::runtime_error(file + ": there is nothing to see in this file");
  return scene;
}

}  // namespace sunlit::scene
