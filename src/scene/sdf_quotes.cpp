#include "scene/sdf_quotes.h"

#include <algorithm>

namespace sunlit::scene {
namespace {

const char* const kBlanks = " \t\r\n";

class Quoter {
 public:
  explicit Quoter(const std::string& text) : text_(text) {}

  std::string quoted() {
    while (at_ < text_.size()) {
      if (text_[at_] != '<') {
        copyTo(text_.find('<', at_));
      } else if (!copyBlock("<!--", "-->") && !copyBlock("<![CDATA[", "]]>") && !copyBlock("<?", "?>")) {
        copyTag();
      }
    }
    return std::move(result_);
  }

 private:
  /// The rest where `end` is npos.
  void copyTo(std::size_t end) {
    end = std::min(end, text_.size());
    result_.append(text_, at_, end - at_);
    at_ = end;
  }

  bool copyBlock(const std::string& begin, const std::string& end) {
    if (text_.compare(at_, begin.size(), begin) != 0) return false;
    const std::size_t found = text_.find(end, at_ + begin.size());
    copyTo(found == std::string::npos ? found : found + end.size());
    return true;
  }

  void copyTag() {
    while (at_ < text_.size() && text_[at_] != '>') {
      copyTo(text_.find_first_of("=>", at_));
      if (at_ < text_.size() && text_[at_] == '=') copyValue();
    }
    copyTo(at_ + 1);
  }

  /// From its '=' on.
  void copyValue() {
    copyTo(text_.find_first_not_of(kBlanks, at_ + 1));
    if (at_ == text_.size()) return;
    const char first = text_[at_];
    if (first == '"' || first == '\'') {
      const std::size_t found = text_.find(first, at_ + 1);
      copyTo(found == std::string::npos ? found : found + 1);
      return;
    }
    result_ += '"';
    copyTo(text_.find_first_of(std::string(kBlanks) + "/>", at_));
    result_ += '"';
  }

  const std::string& text_;
  std::string result_;
  std::size_t at_ = 0;
};

}  // namespace

std::string quotedValues(const std::string& text) {
  return Quoter(text).quoted();
}

}  // namespace sunlit::scene
