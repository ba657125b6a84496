#include "fuzz/reader.h"

#include <new>
#include <stdexcept>

namespace sunlit::fuzz {

std::vector<std::string> filesOf(const std::string& input, std::size_t count) {
  const std::string between = kNextFile;
  std::vector<std::string> files;
  std::size_t begin = 0;
  while (files.size() + 1 < count) {
    const std::size_t end = input.find(between, begin);
    if (end == std::string::npos) break;
    files.push_back(input.substr(begin, end - begin));
    begin = end + between.size();
  }
  files.push_back(input.substr(begin));
  files.resize(count);
  return files;
}

std::string faultOf(const std::string& input) {
  try {
    read(input);
  } catch (const std::bad_alloc& error) {
    return std::string("asks for more memory than there is: ") + error.what();
  } catch (const std::exception& error) {
    const std::string text = error.what();
    if (text.find(named()) == std::string::npos) return "is refused without naming " + named() + ": " + text;
  } catch (...) {
    return "throws what is no std::exception";
  }
  return "";
}

}  // namespace sunlit::fuzz
