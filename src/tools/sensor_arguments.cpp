#include "tools/sensor_arguments.h"

#include <stdexcept>

namespace sunlit::tools {

namespace {

void addOptics(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> vignetting = fieldsOf(words->chain.vignetting),
                           glare = fieldsOf(words->chain.glare);
  line->add("--vignetting", fieldOf(vignetting, "natural"));
  std::vector<Field> polynomial;
  for (const char* key : {"a1", "a2", "a3"})
    polynomial.push_back(studio::explainedAs(fieldOf(vignetting, key), ""));
  line->add("--falloff A1,A2,A3", fieldOf(vignetting, "a1").doc, polynomial);
  line->add("--glare SHARE", fieldOf(glare, "share"));
  line->add("--glare-wings SHARE", fieldOf(glare, "wings"));
  line->add("--hood DEG", fieldOf(glare, "hood"));
  line->add("--blur PX", fieldOf(fieldsOf(words->chain.blur), "sigma"));
}

void addMosaic(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> rows = fieldsOf(words->chain.mosaic);
  line->add("--mosaic", fieldOf(rows, "pattern"));
  line->add("--demosaic", fieldOf(rows, "demosaic"));
}

}  // namespace

void SensorWords::putInto(studio::StudioOptions* options) const {
  studio::ChainOptions& its = options->chains.front();
  its = chain;
  if (!ev100) return;
  its.exposure.mode = image::ExposureMode::kFixed;
  its.exposure.ev100 = *ev100;
}

void SensorWords::requireSense(const studio::CommandLine& line) const {
  if (line.has("--compensation") && ev100) throw std::invalid_argument("--compensation needs --ev auto");
  line.requireWith("--glare-wings", {"--glare"});
  line.requireWith("--hood", {"--glare"});
  line.requireWith("--demosaic", {"--mosaic"});
  line.requireWith("--exposures", {"--exposure-time"});
}

void addSensor(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> rows = fieldsOf(words->chain.exposure);
  const Field& ev100 = fieldOf(rows, "ev100");
  line->add("--ev auto|NUMBER", {"ev", NumberOrWord{&words->ev100, "auto"}, ev100.unit, ev100.range,
                                 "exposure value at ISO 100"});
  line->add("--compensation STOPS", fieldOf(rows, "compensation"));
  line->add("--noise SEED", studio::explainedAs(fieldOf(fieldsOf(words->chain.noise), "seed"),
                                                "adds the noise of a sensor, with this seed"))
      .then([words](const std::string&, const std::string&) { words->chain.noise.enabled = true; })
      .withoutDefault();
  addOptics(line, words);
  addMosaic(line, words);
}

void addShutter(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> rows = fieldsOf(words->chain.shutter);
  line->add("--line-delay US", fieldOf(rows, "line_delay"));
  line->add("--exposure-time MS|auto", fieldOf(rows, "exposure_time"));
  line->add("--exposures NUMBER", fieldOf(rows, "exposures"));
}

}  // namespace sunlit::tools
