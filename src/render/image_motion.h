/// How fast what a moving camera sees runs over its picture, and how finely that picture is divided for it.
#pragma once

#include "sunlit/image/images.h"
#include "sunlit/image/lens.h"
#include "sunlit/quantity/motion.h"

namespace sunlit::render {

/// px/s that all but the fastest twentieth of the picture stay below, and of what is before the sky in it.
/// `motion` is in the optical frame; `depth` as Renderer::depth(), where NaN is so far away that only turning
/// moves it.
double imageMotion_px_s(const image::DepthImage& depth, const image::Lens& lens, const Motion& motion);

/// Pictures that one in which all runs by `smear_px` is the mean of: one a pixel, `most` at most.
int exposuresOf(double smear_px, int most);

/// Bands of rows that each see at one moment, of a picture in which all runs by `skew_px` from the first row
/// to the last: within a band by a quarter of a pixel, where kMostBands are enough. Few different numbers,
/// so that what is made for one is used again.
int bandCount(double skew_px, int height);
constexpr int kMostBands = 64;

/// `camera`, whose pixels look a part of a pixel aside: number 0 nowhere, 1 to kPatterns each otherwise,
/// evenly over the pixel; 2 k opposite to 2 k − 1.
constexpr int kPatterns = 16;
image::PinholeCamera shifted(const image::PinholeCamera& camera, int pattern);

/// Which of these an exposure of several has: as different ones as there are, whose mean is none.
int patternOf(int exposure, int exposures);

/// The camera of some rows of `camera`.
image::PinholeCamera rowsOf(const image::PinholeCamera& camera, int first, int count);

}  // namespace sunlit::render
