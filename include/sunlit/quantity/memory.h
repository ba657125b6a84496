/// Memory that ends, told in words, since what() of a std::bad_alloc is but its name; and memory that is
/// kept.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace sunlit {

/// "not enough memory: DOING".
class OutOfMemory : public std::runtime_error {
 public:
  explicit OutOfMemory(const std::string& doing) : std::runtime_error("not enough memory: " + doing) {}
};

/// What `work` gives. Throws OutOfMemory where memory ends within it, and what else it throws.
template <typename Work>
decltype(auto) inMemory(const std::string& doing, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(doing);
  }
}

/// what() of an exception, or that there was not enough memory.
inline std::string reasonInWords(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "not enough memory" : error.what();
}

/// From now on this process keeps what it frees, for what needs as much again: where each picture takes and
/// frees 150 MB, as under a sun that moves, a third of the time goes to the system, which hands out empty
/// pages anew. It grows no larger by that than it was at most. Only where malloc is that of glibc.
void keepFreedMemory();

}  // namespace sunlit
