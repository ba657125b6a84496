#include "sunlit/ros/parameter_reader.h"

#include <ros/master.h>
#include <ros/names.h>
#include <ros/this_node.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "sunlit/quantity/comma_list.h"

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

/// XmlRpcValue of ROS 1.14 shows its members to those alone who may change it.
XmlRpcValue& withMembers(const XmlRpcValue& value) {
  return const_cast<XmlRpcValue&>(value);
}

const XmlRpcValue* descend(const XmlRpcValue& tree, const std::string& key) {
  const XmlRpcValue* at = &tree;
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '/');) {
    if (at->getType() != XmlRpcValue::TypeStruct || !at->hasMember(part)) return nullptr;
    at = &withMembers(*at)[part];
  }
  return at;
}

/// XmlRpcValue reads through non-const conversions, so they need a copy.
template <typename T>
T as(XmlRpcValue value) {
  return static_cast<T>(value);
}

/// In messages texts stand in quotes.
std::string quoted(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeString ? '"' + as<std::string>(value) + '"' : plainText(value);
}

/// Nothing for what no field holds, such as a map.
std::optional<Field::Value> asFieldValue(const XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return as<bool>(value);
    case XmlRpcValue::TypeInt:
      return as<int>(value);
    case XmlRpcValue::TypeDouble:
      return as<double>(value);
    case XmlRpcValue::TypeString:
      return as<std::string>(value);
    case XmlRpcValue::TypeArray:
      break;
    default:
      return std::nullopt;
  }
  XmlRpcValue list = value;
  std::vector<std::string> words;
  for (int i = 0; i < list.size(); ++i) {
    if (list[i].getType() != XmlRpcValue::TypeString) return std::nullopt;
    words.push_back(static_cast<std::string>(list[i]));
  }
  return words;
}

/// As shells do at the beginning of a word, but not within NAME:=~/folder.
void expandHome(std::string* text) {
  const char* const home = std::getenv("HOME");
  if (home != nullptr && text->compare(0, 2, "~/") == 0) text->replace(0, 1, home);
}

void expandHome(Field::Value* value) {
  if (auto* text = std::get_if<std::string>(value)) expandHome(text);
  if (auto* words = std::get_if<std::vector<std::string>>(value)) {
    for (std::string& word : *words) expandHome(&word);
  }
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

/// What is asked for below `key`.
std::vector<std::string> keysBelow(const std::string& key, const std::set<std::string>& asked) {
  std::vector<std::string> keys;
  for (auto below = asked.lower_bound(key + "/");
       below != asked.end() && below->compare(0, key.size() + 1, key + "/") == 0; ++below)
    keys.push_back(below->substr(key.size() + 1));
  return keys;
}

/// Nothing stands there, and keys below it are asked for: `{}`, or all of them are commented out.
bool isEmptyGroup(const XmlRpcValue& value, const std::string& key, const std::set<std::string>& asked) {
  const bool is_struct = value.getType() == XmlRpcValue::TypeStruct;
  return (!value.valid() || (is_struct && value.size() == 0)) && !keysBelow(key, asked).empty();
}

/// The first leaf of `tree` that no asked key equals or contains.
std::optional<std::string> firstUnknown(const XmlRpcValue& tree, const std::string& prefix,
                                        const std::set<std::string>& asked) {
  for (const auto& [name, value] : withMembers(tree)) {
    const std::string key = prefix + name;
    if (asked.count(key) != 0 || isEmptyGroup(value, key, asked)) continue;
    if (value.getType() != XmlRpcValue::TypeStruct || value.size() == 0) return key;
    if (auto unknown = firstUnknown(value, key + "/", asked)) return unknown;
  }
  return std::nullopt;
}

/// Throws where the master does not say: roscpp tells that and no parameters alike, and a node would run by
/// its defaults.
bool hasAny(const std::string& name) {
  XmlRpcValue request, response, answer;
  request[0] = ros::this_node::getName();
  request[1] = name;
  if (!ros::master::execute("hasParam", request, response, answer, false) ||
      answer.getType() != XmlRpcValue::TypeBoolean)
    throw std::runtime_error("the master at " + ros::master::getURI() + " does not tell the parameters of " +
                             name + ": is it still running?");
  return static_cast<bool>(answer);
}

XmlRpcValue fetch(const ros::NodeHandle& node) {
  XmlRpcValue tree;
  const std::string& name = node.getNamespace();
  if (!hasAny(name)) return {};
  if (!node.getParam(name, tree))
    throw std::runtime_error("the master at " + ros::master::getURI() + " has parameters of " + name +
                             ", but does not tell them: is it still running?");
  return tree;
}

}  // namespace

std::string plainText(XmlRpcValue value) {
  if (const auto plain = asFieldValue(value)) return sunlit::textOf(*plain);
  std::string text;
  if (value.getType() == XmlRpcValue::TypeArray) {
    for (int i = 0; i < value.size(); ++i) text += (i == 0 ? "" : ", ") + plainText(value[i]);
    return "[" + text + "]";
  }
  if (value.getType() != XmlRpcValue::TypeStruct) return value.toXml();
  for (auto& member : value)
    text += (text.empty() ? "" : ", ") + member.first + ": " + plainText(member.second);
  return "{" + text + "}";
}

std::string notAsText(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeString ? ", not a text (as which rosrun passes on _name:=value)"
                                                    : "";
}

std::string wholeName(const std::string& file) {
  if (file.empty() || std::filesystem::path(file).is_absolute()) return file;
  std::error_code no_folder;  // of this process: it may be removed
  const std::filesystem::path whole = std::filesystem::absolute(file, no_folder);
  if (no_folder) return file;
  std::error_code not_searched;
  const std::filesystem::path plain = std::filesystem::weakly_canonical(whole, not_searched);
  return (not_searched ? whole : plain).string();
}

ParameterReader::ParameterReader(const ros::NodeHandle& node)
    : ParameterReader(fetch(node), node.getNamespace()) {}

ParameterReader::ParameterReader(const XmlRpcValue& tree, const std::string& name) {
  if (tree.valid() && tree.getType() != XmlRpcValue::TypeStruct) {
    throw std::invalid_argument(name + " is " + quoted(tree) + ", but must be a map from names to values");
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
  const std::string last = lastPart(key);
  const XmlRpcValue* found = nullptr;
  for (const auto& layer : layers_) {
    layer->asked.insert(key);
    if (layer->by_last_part) layer->asked.insert(last);
    if (found != nullptr || !layer->tree.valid()) continue;
    found = descend(layer->tree, key);
    if (!layer->by_last_part || last == key) continue;
    const XmlRpcValue* by_last_part = descend(layer->tree, last);
    if (found != nullptr && by_last_part != nullptr)
      throw std::invalid_argument("parameters " + layer->name + "/" + key + " and " + layer->name + "/" +
                                  last + " are both given, and the same");
    if (found == nullptr) found = by_last_part;
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
  refuse("parameter " + fullName(key), quoted(value), allowed);
}

bool ParameterReader::has(const std::string& key) const {
  return find(key) != nullptr;
}

void ParameterReader::read(const std::vector<Field>& rows) const {
  for (const Field& field : rows) {
    const XmlRpcValue* value = find(field.key);
    if (value == nullptr || std::holds_alternative<OwnForm>(field.place)) continue;
    const bool is_list = std::holds_alternative<std::vector<std::string>*>(field.place);
    if (is_list && value->getType() == XmlRpcValue::TypeString)
      reject(field.key, *value, field.allowed() + notAsText(*value));
    std::optional<Field::Value> typed = asFieldValue(*value);
    if (!typed) reject(field.key, *value, field.allowed());
    expandHome(&*typed);
    field.set(*typed, "parameter " + fullName(field.key));
  }
}

void ParameterReader::check(const std::string& group, const std::function<void()>& check) const {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what(), key = what.substr(0, what.find(' '));
    const std::string name = fullName(group + "/" + key), &top = layers_.front()->name;
    const bool is_below = layers_.front()->by_last_part && name.compare(0, top.size() + 1, top + "/") != 0;
    throw std::invalid_argument("parameter " + name + (is_below ? ", in " + top + "," : "") +
                                what.substr(key.size()));
  }
}

double ParameterReader::number(const std::string& key, double fallback, Range range) const {
  read({{key, &fallback, "", range, ""}});
  return fallback;
}

std::optional<double> ParameterReader::numberOr(const std::string& key, const std::string& word,
                                                std::optional<double> fallback, Range range) const {
  read({{key, NumberOrWord{&fallback, word}, "", range, ""}});
  return fallback;
}

int ParameterReader::integer(const std::string& key, int fallback, Range range) const {
  read({{key, &fallback, "", range, ""}});
  return fallback;
}

bool ParameterReader::flag(const std::string& key, bool fallback) const {
  read({{key, &fallback, "", {}, ""}});
  return fallback;
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) const {
  std::string text = fallback;
  read({{key, &text, "", {}, ""}});
  return text;
}

std::string ParameterReader::choice(const std::string& key, const std::string& fallback,
                                    const std::vector<std::string>& allowed) const {
  auto index =
      static_cast<std::size_t>(std::find(allowed.begin(), allowed.end(), fallback) - allowed.begin());
  read({{key, choiceOf(&index, allowed), "", {}, ""}});
  return index < allowed.size() ? allowed[index] : fallback;
}

std::vector<std::string> ParameterReader::texts(const std::string& key,
                                                const std::vector<std::string>& fallback) const {
  std::vector<std::string> words = fallback;
  read({{key, &words, "", {}, ""}});
  return words;
}

XmlRpcValue ParameterReader::value(const std::string& key) const {
  const XmlRpcValue* value = find(key);
  return value == nullptr ? XmlRpcValue() : *value;
}

std::vector<std::string> ParameterReader::namesBelow(const std::string& key) const {
  std::set<std::string> names;
  for (const auto& layer : layers_) {
    if (!layer->tree.valid()) continue;
    const XmlRpcValue* group = descend(layer->tree, key);
    if (group == nullptr || group->getType() != XmlRpcValue::TypeStruct) continue;
    for (const auto& member : withMembers(*group)) names.insert(member.first);
  }
  return {names.begin(), names.end()};
}

void ParameterReader::rejectUnknown() const {
  const Layer& layer = *layers_.front();
  if (!layer.tree.valid()) return;
  const auto unknown = firstUnknown(layer.tree, "", layer.asked);
  if (!unknown) return;
  if (const std::vector<std::string> keys = keysBelow(*unknown, layer.asked); !keys.empty())
    throw std::invalid_argument("parameter " + layer.name + "/" + *unknown + " is " +
                                quoted(*descend(layer.tree, *unknown)) +
                                ", but must be a map with keys among " + commaList(keys));
  const std::vector<std::string> known(layer.asked.begin(), layer.asked.end());
  const std::string choice = known.empty() ? "nothing can differ here" : "known are " + commaList(known);
  throw std::invalid_argument("parameter " + layer.name + "/" + *unknown + " is unknown" +
                              suggestion(*unknown, layer.asked) + "; " + choice);
}

}  // namespace sunlit::ros_interface
