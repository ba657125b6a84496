#include "tools/sensor_arguments.h"

#include <stdexcept>

namespace sunlit::tools {

image::ExposureOptions SensorWords::exposureOptions() const {
  image::ExposureOptions options = exposure;
  if (ev100) {
    options.mode = image::ExposureMode::kFixed;
    options.ev100 = *ev100;
  }
  return options;
}

void SensorWords::requireSense(const studio::CommandLine& line) const {
  if (line.has("--compensation") && ev100) throw std::invalid_argument("--compensation needs --ev auto");
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
}

}  // namespace sunlit::tools
