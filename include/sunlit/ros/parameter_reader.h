/// Strict reading of ROS parameters: a missing, bad or unknown key is an error that says what would be right.
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::ros_interface {

/// As a person would type it: lists in brackets, maps in braces, texts without quotes.
std::string plainText(XmlRpc::XmlRpcValue value);

/// What is said behind what a list or a map must be: empty unless `value` is a text.
std::string notAsText(const XmlRpc::XmlRpcValue& value);

/// A file or folder by its whole name; "" stays so. roslaunch starts nodes in ROS_HOME (~/.ros), so that a
/// relative one, as it was typed, does not say where it lies.
std::string wholeName(const std::string& file);

/// The parameters of one node, fetched once. Every getter takes the key below the private namespace
/// (`site/latitude`) and the default, and throws std::invalid_argument with full name, value and what is
/// allowed. A number never is NaN or infinite. After the last getter call rejectUnknown().
///
/// Copies share the record of which keys were asked for.
class ParameterReader {
 public:
  /// All parameters below the namespace of `node`, usually ros::NodeHandle("~"). Throws std::runtime_error
  /// where the master does not tell whether there are any, and std::invalid_argument where a value stands in
  /// the place of the namespace.
  explicit ParameterReader(const ros::NodeHandle& node);
  /// Parameters at hand, such as a file's; `name` stands before the keys in messages.
  ParameterReader(const XmlRpc::XmlRpcValue& tree, const std::string& name);

  /// A reader that looks into `overrides` first, by the whole key (`site/latitude`) or its last part
  /// (`latitude`), and here where they say nothing. Its rejectUnknown() speaks of the overrides.
  ParameterReader withOverrides(const XmlRpc::XmlRpcValue& overrides, const std::string& name) const;

  /// Sets every row for which there is a parameter of its key; the others stay as they are. Texts that begin
  /// with ~/ begin with the home folder then. A row of a form of its own only becomes known: value() reads
  /// it.
  void read(const std::vector<Field>& rows) const;
  /// Calls `check`, whose refusals begin with a key of `group`: it gets "parameter" and its full name, behind
  /// which the overrides are named where it is none of theirs.
  void check(const std::string& group, const std::function<void()>& check) const;

  bool has(const std::string& key) const;
  double number(const std::string& key, double fallback, Range range = {}) const;
  /// A number, or the word `word`: then nothing.
  std::optional<double> numberOr(const std::string& key, const std::string& word,
                                 std::optional<double> fallback, Range range = {}) const;
  int integer(const std::string& key, int fallback, Range range = {}) const;
  bool flag(const std::string& key, bool fallback) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  /// One of `allowed`.
  std::string choice(const std::string& key, const std::string& fallback,
                     const std::vector<std::string>& allowed) const;
  std::vector<std::string> texts(const std::string& key, const std::vector<std::string>& fallback) const;
  /// A value of any type, with all below it; an invalid XmlRpcValue where there is none. The caller checks
  /// it.
  XmlRpc::XmlRpcValue value(const std::string& key) const;

  /// Names of all that stands right below `key`; none of them counts as asked for.
  std::vector<std::string> namesBelow(const std::string& key) const;

  /// Throws naming the first key that nobody asked for, and the keys that are known.
  void rejectUnknown() const;
  /// "/node/site/latitude": as a key is called in messages.
  std::string fullName(const std::string& key) const;

 private:
  struct Layer;
  explicit ParameterReader(std::vector<std::shared_ptr<Layer>> layers);
  const XmlRpc::XmlRpcValue* find(const std::string& key) const;
  [[noreturn]] void reject(const std::string& key, const XmlRpc::XmlRpcValue& value,
                           const std::string& allowed) const;

  std::vector<std::shared_ptr<Layer>>
      layers_;  // searched in order; the first is the one rejectUnknown() checks
};

}  // namespace sunlit::ros_interface
