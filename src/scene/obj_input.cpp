#include "scene/obj_input.h"

#include <algorithm>
#include <array>
#include <cctype>
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
#include "sunlit/image/files.h"

namespace sunlit::scene {
namespace {

const std::string kEnds("\n\r\f\0", 4);  ///< of lines, as Assimp has it

std::string contentOf(const std::string& path) {
  image::requireNoDevice(path);
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Calls use(line, number), from 1 on, for each.
template <typename Use>
void forEachLine(const std::string& text, const Use& use) {
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find_first_of(kEnds, at), text.size());
    use(text.substr(at, end - at), number);
    at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
}

/// Without a blank at its end; nothing where the line's first word is another.
std::string behind(const std::string& line, const std::string& word) {
  if (line.compare(0, word.size(), word) != 0 || line.size() == word.size()) return {};
  if (line[word.size()] != ' ' && line[word.size()] != '\t') return {};
  const std::size_t begin = line.find_first_not_of(" \t", word.size());
  if (begin == std::string::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t") + 1 - begin);
}

/// One that begins with a blank or a # is no line of a library.
void requireMaterialFirst(const std::string& path, const std::string& text) {
  bool has_material = false;
  forEachLine(text, [&](const std::string& line, std::size_t number) {
    if (has_material || line.empty() || std::isalpha(static_cast<unsigned char>(line[0])) == 0) return;
    has_material = line.compare(0, 6, "newmtl") == 0;
    if (!has_material)
      throw std::runtime_error(path + ":" + std::to_string(number) + ": '" +
                               line.substr(0, line.find_first_of(" \t")) +
                               "' stands before the first newmtl, and is of no material");
  });
}

void requireNoCommas(const std::string& path, const std::string& text) {
  forEachLine(text, [&](const std::string& line, std::size_t number) {
    const bool is_numbers =
        line.compare(0, 2, "v ") == 0 || line.compare(0, 3, "vn ") == 0 || line.compare(0, 3, "vt ") == 0;
    if (is_numbers && line.find(',') != std::string::npos && line.find(',') < line.find('#'))
      throw std::runtime_error(path + ":" + std::to_string(number) + ": '" + line +
                               "' has a comma; decimals stand behind a point");
  });
}

bool isNumber(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789+-.eE") == std::string::npos;
}

/// A line of a library without -o, -s and -t, each with its one to three numbers.
std::string withoutPlacement(const std::string& line) {
  std::istringstream words(line);
  std::string first, word, rest;
  words >> first;
  if (first.compare(0, 4, "map_") != 0 && first != "norm" && first != "bump" && first != "disp") return line;
  bool is_placement = false, is_changed = false;
  int numbers = 0;
  while (words >> word) {
    if (is_placement && numbers < 3 && isNumber(word)) {
      ++numbers;
      continue;
    }
    is_placement = word == "-o" || word == "-s" || word == "-t";
    numbers = 0;
    is_changed = is_changed || is_placement;
    if (!is_placement) rest += ' ' + word;
  }
  return is_changed ? first + rest : line;
}

std::string withoutPlacements(const std::string& text) {
  std::string plain;
  forEachLine(text, [&](const std::string& line, std::size_t) { plain += withoutPlacement(line) + '\n'; });
  return plain;
}

/// Materials that have a picture of colour and no colour get a white one, which multiplies it; Assimp's is
/// 0.6.
std::string withColors(const std::string& text) {
  std::vector<std::array<bool, 2>> has{
      {}};  // Kd and map_Kd, of what is before the first material and of each
  const auto is = [](const std::string& line, const char* word) {
    const std::size_t begin = line.find_first_not_of(" \t");
    return begin != std::string::npos && !behind(line.substr(begin), word).empty();
  };
  forEachLine(text, [&](const std::string& line, std::size_t) {
    if (is(line, "newmtl")) has.emplace_back();
    has.back()[0] |= is(line, "Kd");
    has.back()[1] |= is(line, "map_Kd");
  });
  std::string colored;
  std::size_t material = 0;
  forEachLine(text, [&](const std::string& line, std::size_t) {
    colored += line + '\n';
    if (is(line, "newmtl") && has[++material][1] && !has[material][0]) colored += "Kd 1 1 1\n";
  });
  return colored;
}

/// How many words a line of a vertex has behind its first one; 0 of other lines, and of one that goes on in
/// the next.
std::size_t wordsOfVertex(const std::string& line) {
  if (line.size() < 2 || line[0] != 'v' || (line[1] != ' ' && line[1] != '\t')) return 0;
  const std::size_t end = std::min(line.find('#'), line.size());
  std::size_t words = 0;
  for (std::size_t i = 1; i < end; ++i) {
    if (line[i] == '\\') return 0;
    const bool is_blank = line[i] == ' ' || line[i] == '\t';
    const bool was_blank = line[i - 1] == ' ' || line[i - 1] == '\t';
    words += !is_blank && was_blank ? 1 : 0;
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
  forEachLine(text, [&](const std::string& line, std::size_t) {
    const std::size_t words = wordsOfVertex(line);
    any_colored = any_colored || words == 6;
    any_bare = any_bare || words == 3 || words == 4;
  });
  if (!any_colored || !any_bare) return text;
  std::string colored;
  forEachLine(text, [&](const std::string& line, std::size_t) {
    const std::size_t words = wordsOfVertex(line);
    const std::string three = words == 4 ? divided(line) : line;
    colored += (wordsOfVertex(three) == 3 ? inWhite(three) : line) + '\n';
  });
  return colored;
}

std::string withoutMark(const std::string& text) {
  return text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? text.substr(3) : text;
}

}  // namespace

Assimp::IOStream* ObjInput::Open(const char* path, const char* mode) {
  if (!Exists(path)) return DefaultIOSystem::Open(path, mode);
  const std::string text = withoutMark(contentOf(path));
  if (extensionOf(path) == ".obj") return streamOf(withColorsOfAll(text));
  requireMaterialFirst(path, text);
  return streamOf(withColors(withoutPlacements(text)));
}

ObjLosses lossesOfObj(const std::string& file) {
  std::set<std::string> used, known;
  std::string missing;
  ObjLosses losses;
  const std::filesystem::path path(file);
  const std::string object = withoutMark(contentOf(file));
  requireNoCommas(file, object);
  forEachLine(object, [&](const std::string& line, std::size_t) {
    if (const std::string material = behind(line, "usemtl"); !material.empty()) used.insert(material);
    const std::string name = behind(line, "mtllib");
    if (name.empty()) return;
    std::filesystem::path library = path.parent_path() / name;
    if (!std::filesystem::exists(library)) {
      missing += (missing.empty() ? "" : ", ") + name;
      library = std::filesystem::path(path).replace_extension("mtl");  // which Assimp then looks for
    }
    bool is_placed = false;
    std::string current;
    forEachLine(withoutMark(contentOf(library.string())), [&](const std::string& one, std::size_t) {
      if (const std::string material = behind(one, "newmtl"); !material.empty()) {
        current = material;
        known.insert(material);
      }
      if (!behind(one, "refl").empty()) losses.mirroring.push_back(current + " of " + library.string());
      is_placed = is_placed || withoutPlacement(one) != one;
    });
    if (is_placed) losses.placed.push_back(library.string());
  });
  for (const std::string& material : used) {
    const bool is_none = material == "None" || material == "(null)";  // as exporters write it
    if (!is_none && known.count(material) == 0)
      losses.materials.push_back(material + " of " + file +
                                 (missing.empty() ? "" : ", whose library is missing: " + missing));
  }
  return losses;
}

}  // namespace sunlit::scene
