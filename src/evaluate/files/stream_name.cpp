#include "sunlit/evaluate/files/stream_name.h"

#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

// Of the C locale, whatever the process has set.
bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool isWordCharacter(char c) {
  return isLetter(c) || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

bool isStreamName(const std::string& name) {
  if (name.empty() || !isLetter(name.front()) || name.back() == '/') return false;
  char before = '/';
  for (const char c : name) {
    if (c == '/' ? before == '/' : !isWordCharacter(c)) return false;
    before = c;
  }
  return true;
}

void requireStreamName(const std::string& name, const std::string& called) {
  if (isStreamName(name)) return;
  refuse(
      called, '"' + name + '"',
      "the name of a stream: letters, digits and _, first a letter, parts joined by single slashes, none in "
      "front");
}

bool isSelfTest(const std::string& a, const std::string& b) {
  return b == a || b == "self_test/" + a;
}

}  // namespace sunlit::evaluate
