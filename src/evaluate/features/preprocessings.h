/// The ways to prepare a picture for a detector, in a file of its own each.
#pragma once

#include <memory>

#include "sunlit/evaluate/features/preprocessing.h"

namespace sunlit::evaluate {

/// Contrast-limited adaptive histogram equalisation of the grey picture (K. Zuiderveld, Graphics Gems IV,
/// 1994), as cv::CLAHE has it.
std::unique_ptr<Preprocessing> makeClahe();
/// Grey levels v become 255 · (v / 255)^exponent, rounded.
std::unique_ptr<Preprocessing> makeGamma();
/// I = 0.5 + log G − α log B − (1 − α) log R of linear light with 1/λ_G = α/λ_B + (1 − α)/λ_R (W. Maddern et
/// al., "Illumination Invariant Imaging", ICRA 2014, eq. 3 and 4): a colour that a black body lights has the
/// same I whatever the body's temperature and strength, where the channels are narrow bands at the λ. Natural
/// logarithms; pixels are sRGB-encoded, and code 0 counts as code 1. The level is 128 + 127 (I − 0.5),
/// rounded, within 0 … 255; that of any grey is 128.
std::unique_ptr<Preprocessing> makeIlluminationInvariant();

}  // namespace sunlit::evaluate
