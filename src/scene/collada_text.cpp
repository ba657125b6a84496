#include "scene/collada_text.h"

#include <algorithm>

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

std::string withoutBlanksBeforeColors(const std::string& text) {
  std::string mended;
  std::size_t copied = 0;
  for (std::size_t tag = text.find("<color"); tag != std::string::npos; tag = text.find("<color", copied)) {
    const std::size_t end = text.find('>', tag);
    if (end == std::string::npos) break;
    mended.append(text, copied, end + 1 - copied);
    copied = std::min(text.size(), text.find_first_not_of(" \t\r\n", end + 1));
  }
  return mended.append(text, copied, std::string::npos);
}

void nameFilesOfImages(std::string& text) {
  const std::string begin = "<image ", end = "</image>", file = "<init_from>", data = "<data>";
  for (std::size_t from = text.find(begin); from != std::string::npos; from = text.find(begin, from + 1)) {
    const std::size_t to = text.find(end, from);
    if (to == std::string::npos) return;
    if (std::min(text.find(file, from), text.find(data, from)) > to)
      text.insert(to, file + "not given</init_from>");
  }
}

}  // namespace

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

ColladaText readableCollada(const std::string& text) {
  ColladaText readable;
  std::size_t comments = 0;
  readable.text = without(text, "<!--", "-->", &comments);
  readable.text = without(readable.text, "<h>", "</h>", &readable.holes);
  // What remains are polygons as others are, and Assimp 5.0 knows no <ph>.
  std::size_t tags = 0;
  for (const char* tag : {"<ph", "</ph"}) readable.text = without(readable.text, tag, ">", &tags);
  readable.text = withoutBlanksBeforeColors(readable.text);
  nameFilesOfImages(readable.text);
  return readable;
}

}  // namespace sunlit::scene
