/// Where C++ functions begin and end, and what they take: enough of the language to count by.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

namespace sunlit {

/// A function with a body. Lambdas and local classes are part of the one that they stand in.
struct FunctionShape {
  std::string name;            ///< as written where it is defined, such as Sun::rise
  std::size_t first_line = 0;  ///< of its definition, from 1, without what it is a template of
  std::size_t lines = 0;       ///< from there to the closing brace
  std::size_t parameters = 0;
  std::string before;  ///< what stands before the name, since the last declaration: marks, type
};

/// Text with blanks for all that is no code: comments, texts, characters, directives. Lines stay.
class CodeOnly {
 public:
  explicit CodeOnly(const std::string& text) : code_(text) {
    while (at_ < code_.size()) step();
  }
  const std::string& code() const { return code_; }

 private:
  void step() {
    const bool begins_line = code_.find_last_not_of(" \t", at_ == 0 ? 0 : at_ - 1) == code_.rfind('\n', at_);
    if (starts("//") || (code_[at_] == '#' && (begins_line || at_ == 0))) {
      blankLine();
    } else if (starts("/*")) {
      blankTo(code_.find("*/", at_ + 2), 2);
    } else if (starts("R\"")) {
      const std::string end = ")" + code_.substr(at_ + 2, code_.find('(', at_) - at_ - 2) + "\"";
      blankTo(code_.find(end, at_), end.size());
    } else if (code_[at_] == '"' || (code_[at_] == '\'' && !separatesDigits())) {
      std::size_t end = at_ + 1;
      while (end < code_.size() && code_[end] != code_[at_]) end += code_[end] == '\\' ? 2 : 1;
      blankTo(end, 1);
    } else {
      ++at_;
    }
  }
  bool starts(const char* word) const { return code_.compare(at_, 2, word) == 0; }
  /// As in 2'000'000.
  bool separatesDigits() const {
    return at_ > 0 && std::isxdigit(static_cast<unsigned char>(code_[at_ - 1])) != 0;
  }
  /// To its end, and on where a backslash carries it on.
  void blankLine() {
    std::size_t end = code_.find('\n', at_);
    while (end != std::string::npos && code_[end - 1] == '\\') end = code_.find('\n', end + 1);
    blankTo(end, 0);
  }
  void blankTo(std::size_t end, std::size_t more) {
    end = end == std::string::npos ? code_.size() : std::min(end + more, code_.size());
    for (; at_ < end; ++at_)
      if (code_[at_] != '\n') code_[at_] = ' ';
  }

  std::string code_;
  std::size_t at_ = 0;
};

/// Functions of one file, in order.
class FunctionScan {
 public:
  explicit FunctionScan(const std::string& text) : code_(CodeOnly(text).code()) { scope(); }
  const std::vector<FunctionShape>& functions() const { return functions_; }

 private:
  /// Declarations up to the brace that closes a namespace or class, or the end.
  void scope() {
    std::size_t begin = at_;  // of the current declaration
    for (; at_ < code_.size(); ++at_) {
      const char here = code_[at_];
      if (here == '(') {
        at_ = closing(at_);
      } else if (here == ';') {
        begin = at_ + 1;
      } else if (here == '}') {
        return;
      } else if (here == '{' && braces(begin)) {
        begin = at_ + 1;
      }
    }
  }

  /// At the opening brace of a declaration; goes on to the closing one. True if that ends the declaration.
  bool braces(std::size_t begin) {
    static const std::regex opens_scope(R"(^\s*(inline\s+namespace|namespace|class|struct|union|extern)\b)");
    const std::string head = withoutDecoration(code_.substr(begin, at_ - begin));
    if (std::regex_search(head, opens_scope)) {
      ++at_;
      scope();
      return true;
    }
    const std::size_t open = parameterList(head);
    const bool initialises_member = open != std::string::npos && inInitialiserList(head, open);
    if (open == std::string::npos || initialises_member) {
      at_ = closing(at_);
      return false;
    }
    const std::size_t end = closing(at_);
    add(head, open, begin, end);
    at_ = end;
    return true;
  }

  void add(const std::string& head, std::size_t open, std::size_t begin, std::size_t end) {
    static const std::regex last_name(R"(((~|[\w:])+|operator\s*[^\s\w]*|operator[^]*)\s*$)");
    std::smatch name;
    const std::string before = head.substr(0, open);
    std::regex_search(before, name, last_name);
    const std::size_t first = begin + head.find_first_not_of(" \t\n");
    functions_.push_back({name[1], lineOf(first), lineOf(end) - lineOf(first) + 1, parametersIn(head, open),
                          before.substr(0, static_cast<std::size_t>(name.position()))});
  }

  /// Of a declaration: without what has brackets of its own before the parameters. Of the same length.
  static std::string withoutDecoration(std::string head) {
    blank(&head, std::regex(R"(\b(public|private|protected)\s*:)"));
    blank(&head, std::regex(R"(\[\[[^\]]*\]\])"));
    for (const char* word : {"__attribute__", "alignas", "decltype", "noexcept"}) {
      for (std::size_t at = head.find(word); at != std::string::npos; at = head.find(word)) {
        const std::size_t open = head.find_first_not_of(" \n", at + std::string(word).size());
        const bool has_list = open != std::string::npos && head[open] == '(';
        const std::size_t end = has_list ? closing(head, open) + 1 : at + std::string(word).size();
        std::fill(head.begin() + static_cast<long>(at), head.begin() + static_cast<long>(end), ' ');
      }
    }
    const std::size_t word = head.find_first_not_of(" \t\n");
    if (word != std::string::npos && head.compare(word, 8, "template") == 0) {
      const std::size_t end = closing(head, head.find('<', word)) + 1;
      std::fill(head.begin() + static_cast<long>(word), head.begin() + static_cast<long>(end), ' ');
      return withoutDecoration(head);
    }
    return head;
  }

  static void blank(std::string* text, const std::regex& pattern) {
    const std::string before = *text;
    for (auto match = std::sregex_iterator(before.begin(), before.end(), pattern);
         match != std::sregex_iterator(); ++match)
      std::fill_n(text->begin() + match->position(), match->length(), ' ');
  }

  /// Where the parameters of a function begin; npos: it is none.
  static std::size_t parameterList(const std::string& head) {
    static const std::regex symbols(R"(\boperator\s*(\(\s*\)|[^\s\w(]+))");
    std::string plain = head;
    std::smatch symbol;
    if (std::regex_search(head, symbol, symbols))
      std::fill_n(plain.begin() + symbol.position(), symbol.length(), 'o');
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (plain[i] == '=') return std::string::npos;  // a value
      if (plain[i] == '(') return i;
      if (plain[i] == '<' || plain[i] == '[') i = std::min(closing(plain, i), plain.size());
    }
    return std::string::npos;
  }

  /// Whether the brace after `head` belongs to a member of a constructor's list: a name stands before it.
  static bool inInitialiserList(const std::string& head, std::size_t open) {
    const std::size_t after = head.find_first_not_of(" \t\n", closing(head, open) + 1);
    if (after == std::string::npos || head[after] != ':') return false;
    const char last = head[head.find_last_not_of(" \t\n")];
    return std::isalnum(static_cast<unsigned char>(last)) != 0 || last == '_' || last == '>';
  }

  static std::size_t parametersIn(const std::string& head, std::size_t open) {
    const std::size_t end = closing(head, open);
    const std::string list = head.substr(open + 1, end - open - 1);
    if (list.find_first_not_of(" \t\n") == std::string::npos || list == "void") return 0;
    std::size_t count = 1;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (list[i] == ',') ++count;
      if (std::string("(<[{").find(list[i]) != std::string::npos) i = closing(list, i);
    }
    return count;
  }

  /// The bracket that closes the one at `open`, or the text's end. Angles count between angles alone.
  static std::size_t closing(const std::string& text, std::size_t open) {
    const char opens = text[open];
    const char closes = opens == '(' ? ')' : opens == '{' ? '}' : opens == '[' ? ']' : '>';
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
      if (text[i] == opens) ++depth;
      if (text[i] == closes && !(closes == '>' && text[i - 1] == '-') && --depth == 0) return i;
    }
    return text.size();
  }
  std::size_t closing(std::size_t open) const { return closing(code_, open); }

  std::size_t lineOf(std::size_t at) const {
    const std::size_t end = std::min(at, code_.size());
    return 1 +
           static_cast<std::size_t>(std::count(code_.begin(), code_.begin() + static_cast<long>(end), '\n'));
  }

  const std::string code_;
  std::size_t at_ = 0;
  std::vector<FunctionShape> functions_;
};

}  // namespace sunlit
