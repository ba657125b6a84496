// By xxHash 0.8, which fixed what XXH3 is.
#include <xxhash.h>

#include <new>

#include "sunlit/image/content_hash.h"

namespace sunlit::image {

struct ContentHash::State {
  State() {
    if (!xxh3) throw std::bad_alloc();
    XXH3_128bits_reset(xxh3.get());
  }

  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> xxh3{XXH3_createState()};
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {}
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;
ContentHash::~ContentHash() = default;

void ContentHash::addBytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_->xxh3.get(), data, size);
}

ContentHash::Number ContentHash::number() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh3.get());
  return {hash.high64, hash.low64};
}

}  // namespace sunlit::image
