// A reader under libFuzzer, which scripts/fuzz runs.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fuzz/mutate.h"
#include "fuzz/reader.h"
#include "support/temporary_folder.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* const folder = std::getenv("SUNLIT_FUZZ_SEEDS");
  if (folder == nullptr) return 0;
  int number = 0;
  for (const std::string& seed : sunlit::fuzz::seeds())
    sunlit::setContent(std::string(folder) + "/seed" + std::to_string(number++), seed);
  std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fault =
      sunlit::fuzz::faultOf(std::string(reinterpret_cast<const char*>(data), size));  // any bytes
  if (fault.empty()) return 0;
  std::fprintf(stderr, "This input %s\n", fault.c_str());
  std::abort();
}

/// One half as libFuzzer does by itself, the other by words and numbers.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, max_size);
  static const std::vector<std::string> others = sunlit::fuzz::seeds();
  sunlit::fuzz::Dice dice(seed);
  std::string text =
      sunlit::fuzz::mutated(std::string(reinterpret_cast<const char*>(data), size), others, dice);
  text.resize(std::min(text.size(), max_size));
  std::copy(text.begin(), text.end(), data);
  return text.size();
}
