/// From scene luminance to the 8-bit picture: exposure, and the one conversion to sRGB.
#pragma once

#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/quantity/field.h"

namespace sunlit::image {

enum class ExposureMode { kFixed, kAuto };

struct ExposureOptions {
  ExposureMode mode = ExposureMode::kAuto;
  double ev100 = 13.0;
  double compensation_ev = 0.0;
  double night_darkening = 0.15;  ///< 3.5 stops at most in all: dusk looks like dusk, and night like night
  double highlight_protection = 10.0;
  double min_ev100 = -8.0;
  double max_ev100 = 17.0;  ///< at least min_ev100
  double adaptation = 1.0;  ///< see ExposureLag
  int delay = 0;            ///< likewise
};

inline std::vector<Field> fieldsOf(ExposureOptions& options) {
  return {{"mode",
           choiceOf(&options.mode, {"fixed", "auto"}),
           "",
           {},
           "fixed: ev100 for all images; auto: each by its own brightness"},
          {"ev100", &options.ev100, "EV", {-16, 24}, "fixed: exposure value at ISO 100"},
          {"compensation", &options.compensation_ev, "EV", {-8, 8}, "auto: stops brighter (+) or darker (-)"},
          {"night_darkening",
           &options.night_darkening,
           "",
           {0, 0.5},
           "auto: stops darker for each stop that the scene is dimmer than 64 cd/m²"},
          {"highlight_protection",
           &options.highlight_protection,
           "",
           {0, 20},
           "auto: how hard what would burn out pulls the exposure down; 0: not at all"},
          {"min_ev100", &options.min_ev100, "EV", {-16, 24}, "auto: the darkest that the camera adapts to"},
          {"max_ev100",
           &options.max_ev100,
           "EV",
           {-16, 24},
           "auto: the brightest that it adapts to, min_ev100 at least"},
          {"adaptation",
           &options.adaptation,
           "",
           {0.05, 1},
           "auto: how far it goes from one picture to the next towards what it meters; 1: all the way"},
          {"delay",
           &options.delay,
           "",
           {0, 10},
           "auto: pictures until what was metered is used; 3 or 4 are usual, 0 is at once"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const ExposureOptions& options);

/// EV100 with which to develop `image` (cd/m²). Auto metering depends on the image alone, and gives the same
/// bits for any thread count. An image without pixels gives min_ev100.
///
/// Auto: the mean of log luminance becomes 18 % of saturation, level 118 (standard output sensitivity, ISO
/// 12232). The mean is weighted towards the centre column and, from a fifth at the top edge, towards the rows
/// 60 % down and below, so that a bright sky does not darken the ground; it leaves out the darkest and
/// brightest 5 % of the weight, so that the sun's disc, a lamp or a black hole that enters the picture does
/// not make the exposure jump. Black and NaN count as darkest. Less than daylight is shown darker than 18 %,
/// by night_darkening. What would burn out cuts the exposure by d stops, where d is highlight_protection
/// times the mean over all pixels of the stops by which the brightest channel is then above 70 % of
/// saturation (4 at most for each pixel). All of it is continuous: a small change of the light changes the
/// exposure by little.
double chooseEv100(const LinearImage& image, const ExposureOptions& options);

/// Luminance that just saturates the picture at `ev100`: L = 1.2 · 2^EV100 cd/m² (ISO 12232 saturation-based
/// speed with lens and vignetting factor q = 0.65: 78 / (100 · 0.65)).
double saturationLuminance(double ev100);

/// Scale by saturationLuminance, clip, encode by the sRGB curve (IEC 61966-2-1), round to 8 bit.
Rgb8Image develop(const LinearImage& image, double ev100);

}  // namespace sunlit::image
