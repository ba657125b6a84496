#include "scene/collada_text.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>

#include "scene/collada_tags.h"

namespace sunlit::scene {
namespace {

/// `text` without what stands from each `begin` to the next `end`, and how many of these there were.
std::string without(const std::string& text, const std::string& begin, const std::string& end,
                    std::size_t* count) {
  std::string kept;
  std::size_t copied = 0;
  for (std::size_t from = text.find(begin); from != std::string::npos; from = text.find(begin, copied)) {
    const std::size_t to = text.find(end, from + begin.size());
    if (to == std::string::npos) break;
    kept.append(text, copied, from - copied);
    copied = to + end.size();
    ++*count;
  }
  return kept.append(text, copied, std::string::npos);
}

/// The end of the blanks and comments at `at`.
std::size_t endOfBlanks(const std::string& text, std::size_t at) {
  const std::string begin = "<!--", end = "-->";
  for (;;) {
    at = std::min(text.size(), text.find_first_not_of(" \t\r\n", at));
    if (text.compare(at, begin.size(), begin) != 0) return at;
    const std::size_t last = text.find(end, at + begin.size());
    if (last == std::string::npos) return at;
    at = last + end.size();
  }
}

/// `text` without the blanks and comments behind the tags of these names.
std::string withoutBlanksAfter(const std::string& text, const std::set<std::string>& names) {
  std::string mended;
  std::size_t copied = 0;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (names.count(name) == 0 || at < copied) return;
    mended.append(text, copied, at + tag.size() - copied);
    copied = endOfBlanks(text, at + tag.size());
  });
  return mended.append(text, copied, std::string::npos);
}

/// A picture that no file can be, by what the image is called.
std::string absentFileOf(const std::string& image_tag) {
  const std::string id = valueInTag(image_tag, "id");
  return "image " + (id.empty() ? valueInTag(image_tag, "name") : id) + " (which names no file)";
}

/// The tag of the <image> around `at`; empty where there is none.
std::string imageAround(std::size_t at, const std::string& text) {
  const std::size_t from = text.rfind("<image", at);
  if (from == std::string::npos || text.find("</image>", from) < at) return "";
  const std::string tag = text.substr(from, text.find('>', from) + 1 - from);
  return tag[tag.size() - 2] == '/' ? "" : tag;
}

void nameFilesOfImages(std::string& text) {
  const std::string begin = "<image ", end = "</image>", file = "<init_from>", data = "<data>";
  for (std::size_t from = text.find(begin); from != std::string::npos; from = text.find(begin, from + 1)) {
    const std::size_t to = text.find(end, from);
    if (to == std::string::npos) return;
    const std::string tag = text.substr(from, text.find('>', from) - from);
    if (std::min(text.find(file, from), text.find(data, from)) > to)
      text.insert(to, file + absentFileOf(tag) + "</init_from>");
  }
}

std::size_t wordsFrom(std::size_t at, const std::string& text) {
  const std::string blanks = " \t\r\n\f";
  const std::size_t end = std::min(text.size(), text.find('<', at));
  std::size_t words = 0;
  for (at = text.find_first_not_of(blanks, at); at < end; at = text.find_first_not_of(blanks, at)) {
    ++words;
    at = std::min(end, text.find_first_of(blanks, at));
  }
  return words;
}

/// One <lines> or <linestrips>.
struct CountedLines {
  std::size_t at = 0, length = 0;  ///< of the count in the text; no length: there is none to mend
  std::uint64_t count = 0;
  bool is_strips = false;
  std::uint64_t per_corner = 1;
  std::uint64_t parts = 0, numbers = 0;  ///< the <p>, and what stands in all of them

  std::uint64_t there() const { return is_strips ? parts : numbers / per_corner / 2; }
};

/// As its tag has it. What is no whole number stays as it is.
CountedLines linesOf(const std::string& name, const std::string& tag, std::size_t at) {
  CountedLines lines;
  const auto [begin, length] = placeInTag(tag, "count");
  if (length == 0 || tag.find_first_not_of("0123456789", begin) < begin + length) return lines;
  lines.at = at + begin;
  lines.length = length;
  lines.count = std::strtoull(tag.c_str() + begin, nullptr, 10);
  lines.is_strips = name == "linestrips";
  return lines;
}

/// What primitives may name as their material.
std::set<std::string> knownMaterials(const std::string& text,
                                     const std::map<std::string, std::string>& without_effect) {
  std::set<std::string> known;
  const auto add = [&](const std::string& name, const std::string& material) {
    if (!name.empty() && without_effect.count(material) == 0) known.insert(name);
  };
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t) {
    if (name == "instance_material") add(valueInTag(tag, "symbol"), withoutHash(valueInTag(tag, "target")));
    if (name == "material") add(valueInTag(tag, "id"), valueInTag(tag, "id"));
  });
  return known;
}

}  // namespace

std::string withBareMaterials(const std::string& text,
                              const std::map<std::string, std::string>& without_effect) {
  static const std::set<std::string> kPrimitives = {"triangles", "polylist",  "polygons",
                                                    "trifans",   "tristrips", "lines"};
  const std::size_t effects = text.find("</library_effects>"), materials = text.find("</library_materials>");
  if (materials == std::string::npos) return text;
  const std::set<std::string> known = knownMaterials(text, without_effect);
  const std::string quoted = '"' + std::string(kBareMaterial) + '"';
  TextChanges changes;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (kPrimitives.count(name) == 0 || known.count(valueInTag(tag, "material")) == 1) return;
    const auto [begin, length] = placeInTag(tag, "material");
    if (begin != std::string::npos) {
      changes[at + begin] = {length, kBareMaterial};
    } else {
      changes[at + 1 + name.size()] = {0, " material=" + quoted};
    }
  });
  if (changes.empty()) return text;
  const std::string effect = std::string(kBareMaterial) + ", effect";
  const std::string lambert = "<effect id=\"" + effect +
                              "\"><profile_COMMON><technique sid=\"common\"><lambert/></technique>"
                              "</profile_COMMON></effect>";
  if (effects != std::string::npos) {
    changes[effects] = {0, lambert};
  } else {
    changes[text.find("<library_materials")] = {0, "<library_effects>" + lambert + "</library_effects>"};
  }
  changes[materials] = {0, "<material id=" + quoted + " name=" + quoted + "><instance_effect url=\"#" +
                               effect + "\"/></material>"};
  return changed(text, changes);
}

std::string withCountedLines(const std::string& text) {
  std::string mended;
  std::size_t copied = 0;
  CountedLines lines;
  const auto finish = [&] {
    if (lines.length > 0 && lines.count > lines.there()) {
      mended.append(text, copied, lines.at - copied).append(std::to_string(lines.there()));
      copied = lines.at + lines.length;
    }
    lines = {};
  };
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (lines.length > 0 && name == "input") {
      constexpr unsigned long long kLargest = 0x7FFFFFFF;
      const std::string offset = valueInTag(tag, "offset");
      lines.per_corner = std::max<std::uint64_t>(
          lines.per_corner, 1 + std::min(kLargest, std::strtoull(offset.c_str(), nullptr, 10)));
    } else if (lines.length > 0 && name == "p") {
      ++lines.parts;
      lines.numbers += wordsFrom(at + tag.size(), text);
    } else {
      finish();
      if (name == "lines" || name == "linestrips") lines = linesOf(name, tag, at);
    }
  });
  finish();
  return mended.append(text, copied, std::string::npos);
}

std::string withoutAnimations(const std::string& text) {
  const std::string begin = "<library_animations", end = "</library_animations>";
  std::string kept = text;
  for (std::size_t from = kept.find(begin); from != std::string::npos; from = kept.find(begin, from)) {
    const std::size_t tag = kept.find('>', from);
    if (tag == std::string::npos) return text;  // XML that is broken
    std::size_t to = tag + 1;
    if (kept[tag - 1] != '/') {  // else it is empty, and has no end of its own
      const std::size_t found = kept.find(end, tag);
      if (found == std::string::npos) return text;
      to = found + end.size();
    }
    const auto lines = std::count(kept.begin() + static_cast<std::ptrdiff_t>(from),
                                  kept.begin() + static_cast<std::ptrdiff_t>(to), '\n');
    kept.replace(from, to - from, static_cast<std::size_t>(lines), '\n');
  }
  return kept;
}

std::string withWeightsAtOnce(const std::string& text) {
  return withoutBlanksAfter(text, {"v", "vcount"});
}

std::string withAddressesOfImages(const std::string& text) {
  const std::string begin = "<init_from", end = "</init_from>";
  TextChanges addresses;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    std::size_t to = text.find('>', at);
    if (to == std::string::npos) break;
    if (text[to++ - 1] != '/') {
      to = endOfBlanks(text, to);
      if (text.compare(to, end.size(), end) != 0) continue;
      to += end.size();
    }
    const std::string image = imageAround(at, text);
    if (image.empty()) continue;
    const auto first = text.begin() + static_cast<std::ptrdiff_t>(at);
    const auto lines = std::count(first, text.begin() + static_cast<std::ptrdiff_t>(to), '\n');
    addresses[at] = {to - at, "<init_from>" + absentFileOf(image) + end +
                                  std::string(static_cast<std::size_t>(lines), '\n')};
  }
  return changed(text, addresses);
}

ColladaText readableCollada(const std::string& text) {
  ColladaText readable;
  std::size_t comments = 0;
  readable.text = without(text, "<!--", "-->", &comments);
  readable.text = without(readable.text, "<h>", "</h>", &readable.holes);
  // What remains are polygons as others are, and Assimp 5.0 knows no <ph>.
  std::size_t tags = 0;
  for (const char* tag : {"<ph", "</ph"}) readable.text = without(readable.text, tag, ">", &tags);
  readable.text = withoutBlanksAfter(readable.text, {"color"});
  nameFilesOfImages(readable.text);
  return readable;
}

}  // namespace sunlit::scene
