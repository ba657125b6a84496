/// The lines of OBJ files and of their libraries of materials.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace sunlit::scene {

/// Calls use(line, number), from 1 on, for each; they end where Assimp has them end.
template <typename Use>
void forEachObjLine(const std::string& text, const Use& use) {
  static const std::string ends("\n\r\f\0", 4);
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find_first_of(ends, at), text.size());
    use(text.substr(at, end - at), number);
    at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
}

inline bool isBlank(char character) {
  return character == ' ' || character == '\t';
}

/// Up to a # that begins it or follows a blank.
inline std::string withoutComment(const std::string& line) {
  for (std::size_t at = line.find('#'); at != std::string::npos; at = line.find('#', at + 1)) {
    if (at == 0 || isBlank(line[at - 1])) return line.substr(0, at);
  }
  return line;
}

/// Without a blank at its end; nothing where the line's first word is another.
inline std::string behindWord(const std::string& word, const std::string& line) {
  if (line.compare(0, word.size(), word) != 0 || line.size() == word.size()) return {};
  if (!isBlank(line[word.size()])) return {};
  const std::size_t begin = line.find_first_not_of(" \t", word.size());
  if (begin == std::string::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t") + 1 - begin);
}

inline std::vector<std::string> wordsOfLine(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Whether it may be a number in an OBJ file.
inline bool isObjNumber(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789+-.eE") == std::string::npos;
}

}  // namespace sunlit::scene
