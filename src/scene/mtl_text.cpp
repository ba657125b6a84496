#include "scene/mtl_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "scene/obj_lines.h"
#include "scene/uri_text.h"

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

/// As Assimp is to read it.
struct ReadableLine {
  std::string text;
  bool is_placed = false;  ///< it had -o, -s or -t
};

/// Without -o, -s and -t, each with its one to three numbers, and -cc with its word.
ReadableLine withoutOptions(const std::string& line) {
  const LineWords words = wordsOfLine(line);
  if (words.empty()) return {line};
  const std::string& first = words[0];
  if (first.compare(0, 4, "map_") != 0 && first != "norm" && first != "bump" && first != "disp")
    return {line};
  ReadableLine readable;
  std::string rest;
  int numbers = 0;  // that may yet follow
  bool is_changed = false;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (numbers > 0 && isObjNumber(words[i])) {
      --numbers;
      continue;
    }
    const bool is_placement = words[i] == "-o" || words[i] == "-s" || words[i] == "-t";
    const bool is_correction = words[i] == "-cc" && i + 1 < words.size();
    numbers = is_placement ? 3 : 0;
    readable.is_placed = readable.is_placed || is_placement;
    is_changed = is_changed || is_placement || is_correction;
    if (is_correction) ++i;
    if (!is_placement && !is_correction) rest += ' ' + words[i];
  }
  readable.text = is_changed ? first + rest : line;
  return readable;
}

bool isColor(const LineWords& words) {
  static const std::set<std::string> colors = {"Ka", "Kd", "Ks", "Ke", "Tf"};
  return words.size() > 1 && colors.count(words[0]) == 1;
}

bool isHalo(const LineWords& words) {
  return words.size() > 1 && words[0] == "d" && words[1] == "-halo";
}

bool isColorOfNoRgb(const LineWords& words) {
  return isColor(words) && (words[1] == "xyz" || words[1] == "spectral");
}

std::string readableLine(const std::string& line) {
  const LineWords words = wordsOfLine(withoutComment(line));
  if (words.empty()) return line;
  if (words[0] == "aniso" || words[0] == "anisor" || words[0] == "decal" || isColorOfNoRgb(words)) return {};
  if (isHalo(words)) return words.size() > 2 ? "d " + words[2] : std::string();
  // A lone number is that of all three colours.
  if (isColor(words) && words.size() == 2) return words[0] + ' ' + words[1] + ' ' + words[1] + ' ' + words[1];
  return withoutOptions(line).text;
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

/// Where the values of an option begin; behind the last word where there is none.
std::size_t placeOf(const std::string& option, const LineWords& words) {
  return std::min<std::size_t>(std::find(words.begin(), words.end(), option) - words.begin() + 1,
                               words.size());
}

/// Whether a picture of that word is read by the channel.
bool isUsualChannel(const std::string& word, const std::string& channel) {
  if (word == "map_pr") return channel == "g" || channel == "l";
  if (word == "map_pm") return channel == "b" || channel == "l";
  return word == "map_d" && (channel == "m" || channel == "l");
}

/// What of a picture is lost, be it all.
std::vector<std::string> lossesOfPicture(const LineWords& words) {
  static const std::set<std::string> rendered = {"map_kd", "map_ke", "map_emissive", "map_d",
                                                 "map_pr", "map_pm", "map_kn",       "norm"};
  static const std::set<std::string> named_later = {"map_ka", "map_ks", "map_ns", "map_bump", "map_disp"};
  static const std::string filter = "map_aat";  // no picture
  if (words.size() < 2) return {};
  const std::string first = lowerCase(words[0]);
  if (rendered.count(first) == 0) {
    const bool is_lost = first.compare(0, 4, "map_") == 0 && named_later.count(first) == 0 && first != filter;
    return is_lost ? std::vector<std::string>{words[0] + ", a picture: without it"}
                   : std::vector<std::string>();
  }
  std::vector<std::string> losses;
  const std::size_t range = placeOf("-mm", words), channel = placeOf("-imfchan", words),
                    bump = placeOf("-bm", words);
  if (range < words.size() && (numberIn(words, range) != 0.0 || numberIn(words, range + 1) != 1.0))
    losses.push_back(words[0] + " -mm, a base and a gain of its picture: without them");
  if (channel < words.size() && !isUsualChannel(first, words[channel]))
    losses.push_back(words[0] + " -imfchan, one channel of its picture: as without it");
  if (bump < words.size() && (first == "norm" || first == "map_kn") && numberIn(words, bump) != 1.0)
    losses.push_back(words[0] + " -bm, how high its bumps are: as its picture says");
  return losses;
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
    const LineWords words = wordsOfLine(line);
    std::vector<std::string> losses = lossesOfPicture(words);
    if (const std::string loss = lossOf(words); !loss.empty()) losses.push_back(loss);
    for (const std::string& loss : losses)
      content.not_rendered.push_back(current + " of " + path + ": " + loss);
    content.is_placed = content.is_placed || withoutOptions(line).is_placed;
  });
  return content;
}

}  // namespace sunlit::scene
