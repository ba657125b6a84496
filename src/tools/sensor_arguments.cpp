#include "tools/sensor_arguments.h"

#include <stdexcept>

namespace sunlit::tools {

namespace {

void addOptics(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> vignetting = fieldsOf(words->vignetting), glare = fieldsOf(words->glare);
  line->add("--vignetting", fieldOf(vignetting, "natural"));
  std::vector<Field> polynomial;
  for (const char* key : {"a1", "a2", "a3"})
    polynomial.push_back(studio::explainedAs(fieldOf(vignetting, key), ""));
  line->add("--falloff A1,A2,A3", fieldOf(vignetting, "a1").doc, polynomial);
  line->add("--glare SHARE", fieldOf(glare, "share"));
  line->add("--glare-wings SHARE", fieldOf(glare, "wings"));
  line->add("--hood DEG", fieldOf(glare, "hood"));
  line->add("--blur PX", fieldOf(fieldsOf(words->blur), "sigma"));
}

void addMosaic(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> rows = fieldsOf(words->mosaic);
  line->add("--mosaic", fieldOf(rows, "pattern"));
  line->add("--demosaic", fieldOf(rows, "demosaic"));
}

}  // namespace

void SensorWords::putInto(studio::StudioOptions* options) const {
  options->exposure = exposure;
  if (ev100) {
    options->exposure.mode = image::ExposureMode::kFixed;
    options->exposure.ev100 = *ev100;
  }
  options->noise = noise;
  options->vignetting = vignetting;
  options->glare = glare;
  options->blur = blur;
  options->mosaic = mosaic;
}

void SensorWords::requireSense(const studio::CommandLine& line) const {
  if (line.has("--compensation") && ev100) throw std::invalid_argument("--compensation needs --ev auto");
  line.requireWith("--glare-wings", "--glare");
  line.requireWith("--hood", "--glare");
  line.requireWith("--demosaic", "--mosaic");
}

void addSensor(studio::CommandLine* line, SensorWords* words) {
  const std::vector<Field> rows = fieldsOf(words->exposure);
  const Field& ev100 = fieldOf(rows, "ev100");
  line->add("--ev auto|NUMBER", {"ev", NumberOrWord{&words->ev100, "auto"}, ev100.unit, ev100.range,
                                 "exposure value at ISO 100"});
  line->add("--compensation STOPS", fieldOf(rows, "compensation"));
  line->add("--noise SEED", studio::explainedAs(fieldOf(fieldsOf(words->noise), "seed"),
                                                "adds the noise of a sensor, with this seed"))
      .then([words](const std::string&, const std::string&) { words->noise.enabled = true; })
      .withoutDefault();
  addOptics(line, words);
  addMosaic(line, words);
}

}  // namespace sunlit::tools
