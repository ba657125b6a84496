#include "require.h"

#include <sstream>
#include <stdexcept>

namespace sunlit::sky {

void requireWithin(const char* key, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    std::ostringstream message;
    message << key << ": " << value << " is outside " << low << " … " << high;
    throw std::invalid_argument(message.str());
  }
}

}  // namespace sunlit::sky
