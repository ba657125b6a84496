#include "scene/ogre_words.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace sunlit::scene {
namespace {

/// What may have a parent; elsewhere a colon is a letter, as of addresses.
const std::set<std::string> kHeirs = {"material", "technique", "pass", "texture_unit", "abstract"};

/// A text being read.
class ScriptReader {
 public:
  explicit ScriptReader(const std::string& text) : text_(text) {}

  std::vector<ScriptWords> lines() {
    while (at_ < text_.size()) {
      if (text_.compare(at_, 2, "//") == 0) {
        at_ = text_.find('\n', at_);
      } else if (text_.compare(at_, 2, "/*") == 0) {
        at_ = behind("*/", at_ + 2);
        endWord();
      } else if (text_[at_] == '"') {
        readQuoted();
      } else {
        readLetter(text_[at_++]);
      }
      if (at_ == std::string::npos) break;
    }
    endLine();
    return std::move(lines_);
  }

 private:
  std::size_t behind(const std::string& end, std::size_t from) const {
    const std::size_t found = text_.find(end, from);
    return found == std::string::npos ? found : found + end.size();
  }

  /// A word, with blanks and all; what is not closed ends with its line.
  void readQuoted() {
    endWord();
    const std::size_t end = std::min(text_.find_first_of("\"\n", at_ + 1), text_.size());
    addWord(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end < text_.size() && text_[end] == '"' ? end + 1 : end;
  }

  void readLetter(char letter) {
    const bool parts = letter == '{' || letter == '}' ||
                       (letter == ':' && !words_.empty() && kHeirs.count(words_.front()) != 0);
    if (letter == '\n') return endLine();
    if (parts || std::string(" \t\r\v\f").find(letter) != std::string::npos) endWord();
    if (parts)
      words_.emplace_back(1, letter);
    else if (std::string(" \t\r\v\f").find(letter) == std::string::npos)
      word_ += letter;
  }

  void endWord() {
    if (word_.empty()) return;
    const auto known = variables_.find(word_);
    if (known == variables_.end() || (!words_.empty() && words_.back() == "set"))
      addWord(word_);
    else
      addValue(known->second);
    word_.clear();
  }

  /// As words of their own, such as the numbers of a colour; a picture's name and a value to set stay whole.
  void addValue(const std::string& value) {
    const bool to_set = words_.size() > 1 && words_[words_.size() - 2] == "set";
    if (to_set || (!words_.empty() && words_.back() == "texture")) return addWord(value);
    std::istringstream parts(value);
    for (std::string part; parts >> part;) addWord(part);
  }

  /// The third of `set $name value`, which may follow a brace, sets it.
  void addWord(const std::string& word) {
    words_.push_back(word);
    if (words_.size() < 3) return;
    const auto set = words_.end() - 3;
    const bool begins = set == words_.begin() || *(set - 1) == "{" || *(set - 1) == "}";
    if (begins && *set == "set") variables_[*(set + 1)] = word;
  }

  void endLine() {
    endWord();
    if (!words_.empty()) lines_.push_back(std::move(words_));
    words_.clear();
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::string word_;
  ScriptWords words_;
  std::vector<ScriptWords> lines_;
  std::map<std::string, std::string> variables_;  ///< by name, with its $
};

}  // namespace

std::vector<ScriptWords> linesOfScript(const std::string& text) {
  return ScriptReader(text).lines();
}

}  // namespace sunlit::scene
