#include "scene/mtl_text.h"

#include <array>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "scene/obj_lines.h"

namespace sunlit::scene {
namespace {

using LineWords = std::vector<std::string>;

/// One that begins with a blank or a # is no line of a library.
void requireMaterialFirst(const std::string& path, const std::string& text) {
  bool has_material = false;
  forEachObjLine(text, [&](const std::string& line, std::size_t number) {
    if (has_material || line.empty() || std::isalpha(static_cast<unsigned char>(line[0])) == 0) return;
    has_material = line.compare(0, 6, "newmtl") == 0;
    if (!has_material)
      throw std::runtime_error(path + ":" + std::to_string(number) + ": '" +
                               line.substr(0, line.find_first_of(" \t")) +
                               "' stands before the first newmtl, and is of no material");
  });
}

/// A line without -o, -s and -t, each with its one to three numbers.
std::string withoutPlacement(const std::string& line) {
  const LineWords words = wordsOfLine(line);
  if (words.empty()) return line;
  const std::string& first = words[0];
  if (first.compare(0, 4, "map_") != 0 && first != "norm" && first != "bump" && first != "disp") return line;
  std::string rest;
  bool is_placement = false, is_changed = false;
  int numbers = 0;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (is_placement && numbers < 3 && isObjNumber(words[i])) {
      ++numbers;
      continue;
    }
    is_placement = words[i] == "-o" || words[i] == "-s" || words[i] == "-t";
    numbers = 0;
    is_changed = is_changed || is_placement;
    if (!is_placement) rest += ' ' + words[i];
  }
  return is_changed ? first + rest : line;
}

bool isHalo(const LineWords& words) {
  return words.size() > 1 && words[0] == "d" && words[1] == "-halo";
}

bool isColorOfNoRgb(const LineWords& words) {
  static const std::set<std::string> colors = {"Ka", "Kd", "Ks", "Ke", "Tf"};
  return words.size() > 1 && colors.count(words[0]) == 1 && (words[1] == "xyz" || words[1] == "spectral");
}

std::string readableLine(const std::string& line) {
  const LineWords words = wordsOfLine(line);
  if (words.empty()) return line;
  if (words[0] == "aniso" || words[0] == "anisor" || words[0] == "decal" || isColorOfNoRgb(words)) return {};
  if (isHalo(words)) return words.size() > 2 ? "d " + words[2] : std::string();
  return withoutPlacement(line);
}

/// 0 where there is none.
double numberIn(const LineWords& words, std::size_t index) {
  double number = 0.0;
  if (index < words.size()) std::istringstream(words[index]) >> number;
  return number;
}

/// What of a line is lost before Assimp sees it, or by Assimp; empty where that is nothing. The colour of
/// ambient light counts for nothing, however it is told.
std::string lossOf(const LineWords& words) {
  if (words.size() < 2) return {};
  const std::string& first = words[0];
  if (first == "refl") return "a picture of what it mirrors: it mirrors what there is";
  if (first == "aniso" && numberIn(words, 1) > 0.0) return "aniso, a highlight drawn out: a round one";
  if (first == "decal") return "decal, a picture on top of its colour: without it";
  if (isHalo(words) && numberIn(words, 2) < 1.0)
    return "d -halo, an opacity that goes by the angle: the same from everywhere";
  if (isColorOfNoRgb(words) && first != "Ka") return first + " by " + words[1] + ": as if it were not there";
  return {};
}

/// Materials that have a picture of colour and no colour get a white one, which multiplies it; Assimp's is
/// 0.6.
std::string withColors(const std::string& text) {
  std::vector<std::array<bool, 2>> has{
      {}};  // Kd and map_Kd, of what is before the first material and of each
  const auto is = [](const std::string& line, const char* word) {
    const std::size_t begin = line.find_first_not_of(" \t");
    return begin != std::string::npos && !behindWord(word, line.substr(begin)).empty();
  };
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    if (is(line, "newmtl")) has.emplace_back();
    has.back()[0] |= is(line, "Kd");
    has.back()[1] |= is(line, "map_Kd");
  });
  std::string colored;
  std::size_t material = 0;
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    colored += line + '\n';
    if (is(line, "newmtl") && has[++material][1] && !has[material][0]) colored += "Kd 1 1 1\n";
  });
  return colored;
}

}  // namespace

std::string readableMtl(const std::string& text, const std::string& path) {
  requireMaterialFirst(path, text);
  std::string readable;
  forEachObjLine(text, [&](const std::string& line, std::size_t) { readable += readableLine(line) + '\n'; });
  return withColors(readable);
}

MtlContent contentOfMtl(const std::string& text, const std::string& path) {
  MtlContent content;
  std::string current;
  forEachObjLine(text, [&](const std::string& line, std::size_t) {
    if (const std::string material = behindWord("newmtl", line); !material.empty()) {
      current = material;
      content.materials.insert(material);
    }
    if (const std::string loss = lossOf(wordsOfLine(line)); !loss.empty())
      content.not_rendered.push_back(current + " of " + path + ": " + loss);
    content.is_placed = content.is_placed || withoutPlacement(line) != line;
  });
  return content;
}

}  // namespace sunlit::scene
