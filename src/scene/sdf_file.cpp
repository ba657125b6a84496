#include "scene/sdf_file.h"

#include <console_bridge/console.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

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

}  // namespace

void readSdf(SdfIncludes& includes, SdfSharing sharing, sdf::Root& root, SceneBuilder& builder) {
  const std::string& file = includes.file();
  checkIsSdf(file);
  std::vector<std::string> printed;
  sdf::Errors errors;
  if (sharing == SdfSharing::kShared) {
    const SdfConsole console;
    errors = root.Load(file, includes.sharingConfig());
    printed = printedLines(console.text());
  }
  if (sharing == SdfSharing::kPlain || !errors.empty()) {
    const SdfConsole console;
    includes.forgetInstances();
    root = sdf::Root();
    errors = root.Load(file, includes.plainConfig());
    printed = printedLines(console.text());
  }
  if (!errors.empty() && !includes.missing().empty()) failMissing(file, errors.front(), includes.missing());
  if (!errors.empty()) fail(file, errors.front(), printed);
  for (const std::string& line : printed) builder.count("× libsdformat: " + line);
}

}  // namespace sunlit::scene
