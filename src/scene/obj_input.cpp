#include "scene/obj_input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

#include "scene/memory_stream.h"
#include "scene/mesh_file.h"
#include "scene/mtl_text.h"
#include "scene/obj_lines.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::scene {
namespace {

std::string contentOf(const std::string& path) {
  image::requireContent(path);
  std::ifstream stream(path, std::ios::binary);
  return utf8Of({std::istreambuf_iterator<char>(stream), {}}, path);
}

void requireNoComma(const std::string& line, std::size_t number, const std::string& file) {
  const bool is_numbers =
      line.compare(0, 2, "v ") == 0 || line.compare(0, 3, "vn ") == 0 || line.compare(0, 3, "vt ") == 0;
  if (is_numbers && line.find(',') != std::string::npos && line.find(',') < line.find('#'))
    throw std::runtime_error(file + ":" + std::to_string(number) + ": '" + line +
                             "' has a comma; decimals stand behind a point");
}

/// How many words a line whose first is `letter` has behind it; 0 of other lines, and of one that goes on in
/// the next.
std::size_t wordsBehind(char letter, const std::string& line) {
  if (line.size() < 2 || line[0] != letter || !isBlank(line[1])) return 0;
  const std::size_t end = std::min(line.find('#'), line.size());
  std::size_t words = 0;
  for (std::size_t i = 1; i < end; ++i) {
    if (line[i] == '\\') return 0;
    words += !isBlank(line[i]) && isBlank(line[i - 1]) ? 1 : 0;
  }
  return words;
}

/// A vertex of three numbers.
std::string inWhite(const std::string& line) {
  return line.substr(0, line.find('#')) + " 1 1 1";
}

/// The three numbers of a vertex that has a fourth, by which they are divided; as it is where that is 0.
std::string divided(const std::string& line) {
  std::istringstream words(line.substr(1));
  std::array<double, 4> numbers{};
  for (double& number : numbers) words >> number;
  if (numbers[3] == 0.0) return line;
  std::ostringstream three;
  three << std::setprecision(std::numeric_limits<float>::max_digits10) << 'v';
  for (std::size_t i = 0; i < 3; ++i) three << ' ' << numbers[i] / numbers[3];
  return three.str();
}

/// Where some vertices have a colour, all get one: Assimp 5.2 keeps a list of colours without gaps.
std::string withColorsOfAll(const std::string& text) {
  bool any_colored = false, any_bare = false;
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    const std::size_t words = wordsBehind('v', line);
    any_colored = any_colored || words == 6;
    any_bare = any_bare || words == 3 || words == 4;
  });
  if (!any_colored || !any_bare) return text;
  std::string colored;
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    const std::size_t words = wordsBehind('v', line);
    const std::string three = words == 4 ? divided(line) : line;
    colored += (wordsBehind('v', three) == 3 ? inWhite(three) : line) + '\n';
  });
  return colored;
}

/// A 0 before each point that begins a word.
std::string withLeadingZeros(const std::string& line) {
  std::string mended;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '.' && (i == 0 || isBlank(line[i - 1]))) mended += '0';
    mended += line[i];
  }
  return mended;
}

/// What `mtllib` names: one library, or several where no file has the whole name.
std::vector<std::string> librariesIn(const std::string& names, const std::string& file) {
  if (names.empty()) return {};  // as of nearly all lines, of which each would be looked for
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  const auto isThere = [&](const std::string& name) { return std::filesystem::exists(folder / name); };
  const std::vector<std::string> words = wordsOfLine(names);
  if (!isThere(names) && std::any_of(words.begin(), words.end(), isThere)) return words;
  return {names};
}

/// Corners of a face without their coordinates of textures.
std::string withoutCoordinates(const std::string& line) {
  std::string bare;
  for (const std::string& word : wordsOfLine(line)) {
    const std::size_t first = word.find('/'),
                      second = first == std::string::npos ? first : word.find('/', first + 1);
    bare += (bare.empty() ? "" : " ") + word.substr(0, first);
    if (second != std::string::npos) bare += '/' + word.substr(second);
  }
  return bare;
}

/// Vertices and faces as Assimp 5.2 reads them: it wants `vt` where faces name some, stops at comments behind
/// faces, counts words of comments that begin as numbers do, does not count numbers that begin with a point,
/// and wants two of `vt`. Each library on a line of its own.
std::string withPlainLines(const std::string& text, const std::string& file) {
  static const std::set<std::string> numbers = {"v", "vn", "vt"}, indices = {"f", "l", "p"};
  bool has_coordinates = false;
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    has_coordinates = has_coordinates || !behindWord("vt", line).empty();
  });
  std::string plain;
  std::string first;     // word of the line
  bool goes_on = false;  // in the next line
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    if (!goes_on) first = line.substr(0, line.find_first_of(" \t"));
    const bool is_numbers = numbers.count(first) == 1, is_whole = !goes_on;
    std::string mended = is_numbers || indices.count(first) == 1 ? withoutComment(line) : line;
    if (is_numbers) mended = withLeadingZeros(mended);
    if (!has_coordinates && indices.count(first) == 1) mended = withoutCoordinates(mended);
    const std::size_t last = mended.find_last_not_of(" \t");
    goes_on = last != std::string::npos && mended[last] == '\\';
    if (first == "vt" && is_whole && !goes_on && wordsOfLine(mended).size() == 2) mended += " 0";
    const std::vector<std::string> libraries = librariesIn(behindWord("mtllib", line), file);
    if (libraries.size() > 1) mended.clear();
    for (std::size_t i = 0; libraries.size() > 1 && i < libraries.size(); ++i)
      mended += (i == 0 ? "mtllib " : "\nmtllib ") + libraries[i];
    plain += mended + '\n';
  });
  return plain;
}

/// What a line of a shape holds that is lost; empty where nothing is.
std::string lostShapeOf(const std::string& line) {
  for (const char* const word : {"call", "curv", "curv2", "surf"})
    if (!behindWord(word, line).empty()) return word;
  const std::size_t corners = wordsBehind('f', line);
  return corners == 1 || corners == 2 ? "a face of " + std::to_string(corners) : "";
}

/// Throws std::runtime_error naming `object`, too, where it cannot be read.
MtlContent contentOfLibrary(const std::string& library, const std::filesystem::path& object) {
  try {
    return contentOfMtl(contentOf(library), library);
  } catch (const image::ContentMissing& problem) {
    throw image::ContentMissing(object.string() + ": its library " + problem.what());
  } catch (const std::runtime_error& problem) {
    throw std::runtime_error(object.string() + ": its library " + problem.what());
  }
}

/// Whether it is there; else the one that Assimp then looks for is added.
bool addLibrary(const std::filesystem::path& object, const std::string& name, ObjLibraries& libraries) {
  std::filesystem::path library = object.parent_path() / name;
  const bool is_there = std::filesystem::exists(library);
  if (!is_there) library = std::filesystem::path(object).replace_extension("mtl");
  libraries.files.push_back(library.string());
  const MtlContent content = contentOfLibrary(library.string(), object);
  libraries.materials.insert(content.materials.begin(), content.materials.end());
  libraries.not_rendered.insert(libraries.not_rendered.end(), content.not_rendered.begin(),
                                content.not_rendered.end());
  if (content.is_placed) libraries.placed.push_back(library.string());
  return is_there;
}

}  // namespace

Assimp::IOStream* ObjInput::Open(const char* path, const char* mode) {
  if (!Exists(path)) return DefaultIOSystem::Open(path, mode);
  const std::string text = contentOf(path);
  const bool is_object = extensionOf(path) == ".obj";
  return streamOf(is_object ? withColorsOfAll(withPlainLines(text, path)) : readableMtl(text, path));
}

ObjLibraries librariesOfObj(const std::string& file) {
  std::set<std::string> used;
  std::string missing;
  ObjLibraries libraries;
  const std::filesystem::path path(file);
  forEachObjLine(contentOf(file), [&](const std::string& line, std::size_t number) {
    requireNoComma(line, number, file);
    if (const std::string lost = lostShapeOf(line); !lost.empty())
      libraries.not_read.push_back(lost + " at " + file + ":" + std::to_string(number));
    if (const std::string material = behindWord("usemtl", line); !material.empty()) used.insert(material);
    for (const std::string& name : librariesIn(behindWord("mtllib", line), file)) {
      if (!addLibrary(path, name, libraries)) missing += (missing.empty() ? "" : ", ") + name;
    }
  });
  for (const std::string& material : used) {
    const bool is_none = material == "None" || material == "(null)";  // as exporters write it
    if (!is_none && libraries.materials.count(material) == 0)
      libraries.missing.push_back(material + " of " + file +
                                  (missing.empty() ? "" : ", whose library is missing: " + missing));
  }
  return libraries;
}

}  // namespace sunlit::scene
