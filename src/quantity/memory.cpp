#include "sunlit/quantity/memory.h"

#include <malloc.h>

#include <initializer_list>
#include <limits>

namespace sunlit {

void keepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  // Heaps of threads are given back whole unless so much is wanted at their end, which is all that they hold.
  mallopt(M_TOP_PAD, 64 * kMegabyte);
  // What is larger is mapped by itself, and given back. Older ones take no more than half of a thread's heap.
  for (const int most : {1024 * kMegabyte, 32 * kMegabyte})
    if (mallopt(M_MMAP_THRESHOLD, most) == 1) return;
#endif
}

}  // namespace sunlit
