#include "require_within.h"

#include <sstream>
#include <stdexcept>

namespace sunlit::image {

void requireWithin(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream message;
  message << key << ": " << value << " is outside " << low << " … " << high;
  throw std::invalid_argument(message.str());
}

}  // namespace sunlit::image
