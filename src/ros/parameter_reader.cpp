#include "sunlit/ros/parameter_reader.h"

#include <ros/names.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

namespace sunlit::ros_interface {

using XmlRpc::XmlRpcValue;

struct ParameterReader::Layer {
  XmlRpcValue tree;
  std::string name;             // before the keys in messages
  bool by_last_part = false;    // overrides may name a key by its last part
  std::set<std::string> asked;  // keys looked for, whether there or not
};

namespace {

std::string lastPart(const std::string& key) {
  const auto slash = key.rfind('/');
  return slash == std::string::npos ? key : key.substr(slash + 1);
}

const XmlRpcValue* descend(const XmlRpcValue& tree, const std::string& key) {
  const XmlRpcValue* at = &tree;
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '/');) {
    if (at->getType() != XmlRpcValue::TypeStruct || !at->hasMember(part)) return nullptr;
    at = &(*at)[part];
  }
  return at;
}

/// XmlRpcValue reads through non-const conversions, so they need a copy.
template <typename T>
T as(XmlRpcValue value) {
  return static_cast<T>(value);
}

std::string printed(const XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeString) return "\"" + as<std::string>(value) + "\"";
  if (value.getType() == XmlRpcValue::TypeBoolean) return as<bool>(value) ? "true" : "false";
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string printed(const Range& range) {
  std::ostringstream out;
  const bool below = std::isfinite(range.min);
  const bool above = std::isfinite(range.max);
  if (below && above) out << "from " << range.min << " to " << range.max;
  if (below && !above) out << "of at least " << range.min;
  if (!below && above) out << "of at most " << range.max;
  return out.str();
}

std::optional<double> asNumber(const XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeInt) return as<int>(value);
  if (value.getType() == XmlRpcValue::TypeDouble) return as<double>(value);
  return std::nullopt;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

/// How many letters must be changed, added or left out to make `b` of `a` (Levenshtein 1966).
std::size_t changes(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// " (did you mean KEY?)" where one of `known` is near; else nothing.
std::string suggestion(const std::string& unknown, const std::set<std::string>& known) {
  const std::size_t far = 1 + unknown.size() / 4;  // more than a slip or two
  std::size_t least = far + 1;
  std::string nearest;
  for (const std::string& key : known) {
    const std::size_t distance = changes(unknown, key);
    if (distance >= least) continue;
    least = distance;
    nearest = key;
  }
  return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

/// The first leaf of `tree` that no asked key equals or contains.
std::optional<std::string> firstUnknown(const XmlRpcValue& tree, const std::string& prefix,
                                        const std::set<std::string>& asked) {
  for (auto member = tree.begin(); member != tree.end(); ++member) {
    const std::string key = prefix + member->first;
    if (asked.count(key) != 0) continue;
    const XmlRpcValue& value = member->second;
    if (value.getType() != XmlRpcValue::TypeStruct || value.size() == 0) return key;
    if (auto unknown = firstUnknown(value, key + "/", asked)) return unknown;
  }
  return std::nullopt;
}

XmlRpcValue fetch(const ros::NodeHandle& node) {
  XmlRpcValue tree;
  const std::string& name = node.getNamespace();
  // No parameters at all is an empty reader; a namespace cannot be anything but a map.
  return node.getParam(name, tree) && tree.getType() == XmlRpcValue::TypeStruct ? tree : XmlRpcValue();
}

}  // namespace

ParameterReader::ParameterReader(const ros::NodeHandle& node)
    : ParameterReader(fetch(node), node.getNamespace()) {}

ParameterReader::ParameterReader(const XmlRpcValue& tree, const std::string& name) {
  if (tree.valid() && tree.getType() != XmlRpcValue::TypeStruct) {
    throw std::invalid_argument(name + " is " + printed(tree) + ", but must be a map from names to values");
  }
  layers_.push_back(std::make_shared<Layer>(Layer{tree, name, false, {}}));
}

ParameterReader::ParameterReader(std::vector<std::shared_ptr<Layer>> layers) : layers_(std::move(layers)) {}

ParameterReader ParameterReader::withOverrides(const XmlRpcValue& overrides, const std::string& name) const {
  ParameterReader top(overrides, name);
  top.layers_.front()->by_last_part = true;
  std::vector<std::shared_ptr<Layer>> layers = top.layers_;
  layers.insert(layers.end(), layers_.begin(), layers_.end());
  return ParameterReader(std::move(layers));
}

const XmlRpcValue* ParameterReader::find(const std::string& key) const {
  const XmlRpcValue* found = nullptr;
  for (const auto& layer : layers_) {
    layer->asked.insert(key);
    if (layer->by_last_part) layer->asked.insert(lastPart(key));
    if (found != nullptr || !layer->tree.valid()) continue;
    found = descend(layer->tree, key);
    if (found == nullptr && layer->by_last_part) found = descend(layer->tree, lastPart(key));
  }
  return found;
}

std::string ParameterReader::fullName(const std::string& key) const {
  for (const auto& layer : layers_) {
    if (!layer->tree.valid()) continue;
    if (descend(layer->tree, key) != nullptr) return layer->name + "/" + key;
    if (layer->by_last_part && descend(layer->tree, lastPart(key)) != nullptr) {
      return layer->name + "/" + lastPart(key);
    }
  }
  return layers_.back()->name + "/" + key;
}

void ParameterReader::reject(const std::string& key, const XmlRpcValue& value,
                             const std::string& allowed) const {
  throw std::invalid_argument("parameter " + fullName(key) + " is " + printed(value) + ", but must be " +
                              allowed);
}

bool ParameterReader::has(const std::string& key) const {
  return find(key) != nullptr;
}

double ParameterReader::number(const std::string& key, double fallback, Range range) const {
  const XmlRpcValue* value = find(key);
  if (value == nullptr) return fallback;
  const std::optional<double> number = asNumber(*value);
  if (!number || !std::isfinite(*number) || *number < range.min || *number > range.max) {
    reject(key, *value, "a number " + printed(range));
  }
  return *number;
}

std::optional<double> ParameterReader::numberOr(const std::string& key, const std::string& word,
                                                std::optional<double> fallback, Range range) const {
  const XmlRpcValue* value = find(key);
  if (value == nullptr) return fallback;
  if (value->getType() == XmlRpcValue::TypeString) {
    if (as<std::string>(*value) == word) return std::nullopt;
    reject(key, *value, "\"" + word + "\" or a number " + printed(range));
  }
  return number(key, 0.0, range);
}

int ParameterReader::integer(const std::string& key, int fallback, Range range) const {
  const XmlRpcValue* value = find(key);
  if (value == nullptr) return fallback;
  if (value->getType() != XmlRpcValue::TypeInt || as<int>(*value) < range.min ||
      as<int>(*value) > range.max) {
    reject(key, *value, "a whole number " + printed(range));
  }
  return as<int>(*value);
}

bool ParameterReader::flag(const std::string& key, bool fallback) const {
  const XmlRpcValue* value = find(key);
  if (value == nullptr) return fallback;
  if (value->getType() != XmlRpcValue::TypeBoolean) reject(key, *value, "true or false");
  return as<bool>(*value);
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) const {
  const XmlRpcValue* value = find(key);
  if (value == nullptr) return fallback;
  if (value->getType() != XmlRpcValue::TypeString) reject(key, *value, "text");
  return as<std::string>(*value);
}

std::string ParameterReader::choice(const std::string& key, const std::string& fallback,
                                    const std::vector<std::string>& allowed) const {
  const XmlRpcValue* value = find(key);
  if (value == nullptr) return fallback;
  for (const std::string& word : allowed) {
    if (value->getType() == XmlRpcValue::TypeString && as<std::string>(*value) == word) return word;
  }
  reject(key, *value, "one of " + joined(allowed));
}

std::vector<std::string> ParameterReader::texts(const std::string& key,
                                                const std::vector<std::string>& fallback) const {
  const XmlRpcValue* found = find(key);
  if (found == nullptr) return fallback;
  XmlRpcValue list = *found;
  if (list.getType() == XmlRpcValue::TypeString)
    reject(key, list, "a list of words, [a, b], not a text (as which rosrun passes on _name:=value)");
  if (list.getType() != XmlRpcValue::TypeArray) reject(key, list, "a list of words, [a, b]");
  std::vector<std::string> words;
  for (int i = 0; i < list.size(); ++i) {
    if (list[i].getType() != XmlRpcValue::TypeString) reject(key, list, "a list of words, [a, b]");
    words.push_back(static_cast<std::string>(list[i]));
  }
  return words;
}

XmlRpcValue ParameterReader::value(const std::string& key) const {
  const XmlRpcValue* value = find(key);
  return value == nullptr ? XmlRpcValue() : *value;
}

void ParameterReader::rejectUnknown() const {
  const Layer& layer = *layers_.front();
  if (!layer.tree.valid()) return;
  const auto unknown = firstUnknown(layer.tree, "", layer.asked);
  if (!unknown) return;
  const std::vector<std::string> known(layer.asked.begin(), layer.asked.end());
  const std::string choice = known.empty() ? "nothing can differ here" : "known are " + joined(known);
  throw std::invalid_argument("parameter " + layer.name + "/" + *unknown + " is unknown" +
                              suggestion(*unknown, layer.asked) + "; " + choice);
}

}  // namespace sunlit::ros_interface
