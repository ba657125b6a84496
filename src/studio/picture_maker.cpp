#include "sunlit/studio/picture_maker.h"

namespace sunlit::studio {

std::string pictureMaker() {
  return SUNLIT_VERSION ", pictures " + std::to_string(kPictureVersion);
}

}  // namespace sunlit::studio
