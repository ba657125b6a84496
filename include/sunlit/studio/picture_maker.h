/// Which sunlit makes pictures, so that those of one folder are all of one kind.
#pragma once

#include <string>

namespace sunlit::studio {

/// Goes up whenever pictures of unchanged options change, by whatever makes them: light, sky, drops of rain,
/// lens, exposure, noise. Between two releases they do, and a folder that was begun before would be gone on
/// with.
constexpr int kPictureVersion = 17;

/// Version of sunlit and of its pictures: "0.1.0, pictures 2".
std::string pictureMaker();

}  // namespace sunlit::studio
