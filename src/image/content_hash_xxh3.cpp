// By our own XXH3, where xxHash is older than 0.8.
#include "image/xxh3.h"
#include "sunlit/image/content_hash.h"

namespace sunlit::image {

struct ContentHash::State {
  Xxh3 xxh3;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {}
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;
ContentHash::~ContentHash() = default;

void ContentHash::addBytes(const void* data, std::size_t size) {
  state_->xxh3.add(data, size);
}

ContentHash::Number ContentHash::number() const {
  return state_->xxh3.number();
}

}  // namespace sunlit::image
