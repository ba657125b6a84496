#include "sunlit/image/calibration.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sunlit/quantity/columns.h"
#include "sunlit/quantity/comma_list.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/range.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::image {
namespace {

/// No calibration is a tenth as long; what is, is another file.
constexpr std::size_t kLongest = 1 << 16;

/// Whether camera_calibration wrote it in its other form: a comment with this name stands first, and a
/// section in brackets before all values.
bool looksLikeIni(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    if (line.compare(0, 5, "# oST") == 0) return true;
    if (!line.empty() && line.front() != '#') return line.front() == '[' && line.back() == ']';
  }
  return false;
}

/// One file while it is read; all that it refuses begins with file and line.
class CalibrationFile {
 public:
  explicit CalibrationFile(const std::string& file) : file_(file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file + ": cannot be opened");
    std::string text;
    text.resize(kLongest);
    stream.read(text.data(), static_cast<std::streamsize>(kLongest));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() == kLongest) throw std::runtime_error(file + ": is too long for a calibration");
    text = utf8Of(std::move(text), file);
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      refuseIni(text);
      fail(error.mark, "is not YAML: " + error.msg);
    }
    if (root_.IsMap()) return;
    refuseIni(text);
    fail(root_.Mark(), "is no calibration: there are no keys");
  }

  Calibration read() const {
    Calibration calibration;
    if (const YAML::Node name = root_["camera_name"]; name && name.IsScalar())
      calibration.name = name.Scalar();
    PinholeCamera& camera = calibration.camera;
    camera.width = size("image_width", "width");
    camera.height = size("image_height", "height");
    readCamera(&camera);
    Distortion& distortion = calibration.distortion;
    distortion.model = model();
    distortion.coefficients = numbers("distortion_coefficients", {});
    refusingAt(root_["distortion_coefficients"],
               [&] { requireCoefficients(distortion, "distortion_coefficients"); });
    const std::vector<double> r = numbers("rectification_matrix", 9), p = numbers("projection_matrix", 12);
    std::copy(r.begin(), r.end(), calibration.rectification.begin());
    std::copy(p.begin(), p.end(), calibration.projection.begin());
    refusingAt(root_, [&] { Lens(camera, distortion).widest(); });
    return calibration;
  }

 private:
  void refuseIni(const std::string& text) const {
    if (!looksLikeIni(text)) return;
    throw std::runtime_error(file_ +
                             ": is a calibration in the form .ini, and only that in YAML is read; "
                             "rosrun camera_calibration_parsers convert cal.ini cal.yaml makes one of it");
  }
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    throw std::runtime_error(file_ + ":" + std::to_string(std::max(mark.line, 0) + 1) + ": " + what);
  }
  template <typename Check>
  void refusingAt(const YAML::Node& node, const Check& check) const {
    try {
      check();
    } catch (const std::invalid_argument& error) {
      fail(node.Mark(), error.what());
    }
  }

  YAML::Node required(const std::string& key) const {
    const YAML::Node node = root_[key];
    if (!node) fail(root_.Mark(), key + " is missing, but must be there");
    return node;
  }
  double number(const YAML::Node& node, const std::string& called) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value))
      refusingAt(node, [&] {
        refuse(called, node.IsScalar() ? '"' + node.Scalar() + '"' : "a list or a map", "a number");
      });
    refusingAt(node, [&] { require(called, value, {}); });
    return value;
  }

  int size(const std::string& key, const std::string& row) const {
    const YAML::Node node = required(key);
    PinholeCamera camera;
    int value = 0;
    Field field = fieldOf(fieldsOf(camera), row);
    field.place = &value;
    refusingAt(node, [&] { field.set(number(node, key), key); });
    return value;
  }

  LensModel model() const {
    const YAML::Node node = root_["distortion_model"];
    if (!node) return LensModel::kPlumbBob;
    const std::vector<std::string> names = lensModelNames();
    const auto name = std::find(names.begin(), names.end(), node.IsScalar() ? node.Scalar() : "");
    if (name == names.end()) {
      refusingAt(node, [&] {
        refuse("distortion_model", node.IsScalar() ? '"' + node.Scalar() + '"' : "a list or a map",
               "one of " + commaList(names));
      });
    }
    return static_cast<LensModel>(name - names.begin());
  }

  /// What stands under `data` of a matrix; `count` of them, if that is not 0.
  std::vector<double> numbers(const std::string& key, std::size_t count) const {
    const YAML::Node matrix = required(key);
    const YAML::Node data = matrix.IsMap() ? matrix["data"] : matrix;
    if (!data || !data.IsSequence()) fail(matrix.Mark(), key + ": data is no list of numbers");
    std::vector<double> values;
    for (const YAML::Node& value : data)
      values.push_back(number(value, key + "[" + std::to_string(values.size()) + "]"));
    if (count > 0 && values.size() != count)
      refusingAt(matrix, [&] {
        refuse(key, std::to_string(values.size()) + " numbers", std::to_string(count) + " numbers");
      });
    return values;
  }

  void readCamera(PinholeCamera* camera) const {
    const std::string key = "camera_matrix";
    const std::vector<double> k = numbers(key, 9);
    const auto place = [&](std::size_t i) { return key + "[" + std::to_string(i) + "]"; };
    refusingAt(root_[key], [&] {
      if (k[1] != 0.0) refuse(place(1) + " (skew)", textOf(k[1]), "0");
      for (const std::size_t i : {3, 6, 7}) {
        if (k[i] != 0.0) refuse(place(i), textOf(k[i]), "0");
      }
      if (k[8] != 1.0) refuse(place(8), textOf(k[8]), "1");
      camera->fx = k[0];
      camera->fy = k[4];
      camera->cx = k[2];
      camera->cy = k[5];
      const std::vector<Field> rows = fieldsOf(*camera);
      for (const auto& [row, i] :
           {std::pair<const char*, std::size_t>{"fx", 0}, {"fy", 4}, {"cx", 2}, {"cy", 5}}) {
        const Field& field = fieldOf(rows, row);
        field.set(field.value(), place(i) + " (" + row + ")");
      }
    });
  }

  std::string file_;
  YAML::Node root_;
};

}  // namespace

Calibration calibrationOf(const PinholeCamera& camera) {
  Calibration calibration;
  calibration.camera = camera;
  calibration.projection = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy,
                            camera.cy, 0.0, 0.0,       0.0, 1.0, 0.0};
  return calibration;
}

void requireAgreement(const Calibration& calibration, const std::string& file, const TypedBeside& typed) {
  const Lens lens(calibration.camera, calibration.distortion);
  const bool is_angle = typed.key == "horizontal_fov";
  const double read = is_angle               ? lens.acrossWidth().deg()
                      : typed.key == "width" ? calibration.camera.width
                                             : calibration.camera.height;
  constexpr double kSameAngle_deg = 0.1;
  if (std::abs(typed.value - read) <= (is_angle ? kSameAngle_deg : 0.0)) return;
  refuse(typed.called, textOf(typed.value),
         textOf(read, 6) + (is_angle ? " deg" : " px") + " as in " + file + ", or left out");
}

Calibration readCalibration(const std::string& file) {
  const CalibrationFile opened(file);
  return opened.read();
}

}  // namespace sunlit::image
