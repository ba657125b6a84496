/// What can be set, in one row each: key, where it is kept, unit, range, meaning.
///
/// An options struct has its table beside it, `std::vector<Field> fieldsOf(Options& options)`, whose rows
/// point into `options`. Everything that takes, checks, explains or records a setting goes by these rows; the
/// defaults are those of a default-constructed struct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/range.h"

namespace sunlit {

/// One of several words.
struct Choice {
  std::vector<std::string> words;
  std::function<std::size_t()> get;  ///< index of the present one
  std::function<void(std::size_t)> set;
};

/// `words` for the enumerators of `*value` (or for false and true), in their order.
template <typename Enum>
Choice choiceOf(Enum* value, std::vector<std::string> words) {
  return {std::move(words), [value] { return static_cast<std::size_t>(*value); },
          [value](std::size_t index) { *value = static_cast<Enum>(index); }};
}

/// A number, or a word for none.
struct NumberOrWord {
  std::optional<double>* number;
  std::string word;
};

/// A list of some of several words.
struct Choices {
  std::vector<std::string> words;
  std::function<std::vector<std::string>()> get;
  std::function<void(const std::vector<std::string>&)> set;  ///< given only such words
  bool may_be_empty = false;
};

/// What has a form of its own and is read elsewhere, such as a list of pairs; what it is as people type it.
struct OwnForm {
  std::string present;
};

struct Field {
  using Place = std::variant<double*, Angle*, int*, std::int64_t*, std::size_t*, bool*, std::string*,
                             std::vector<std::string>*, Choice, Choices, NumberOrWord, OwnForm>;
  /// How values travel; a whole number of type double is as good as one of type int.
  using Value = std::variant<bool, int, double, std::string, std::vector<std::string>>;

  std::string key;  ///< as people type it, "atmosphere/turbidity"
  Place place;      ///< of an Angle, people type degrees
  std::string unit;
  Range range;      ///< of numbers
  std::string doc;  ///< one line

  /// The present value; in degrees, or a word, as people type it.
  Value value() const;
  std::string text() const;
  /// All three throw std::invalid_argument naming key, value and what is allowed; `called` stands in for the
  /// key: "--fov" or "parameter /render/atmosphere/turbidity". As text, words are "a,b"; set() takes "1e3".
  void set(const Value& value, const std::string& called) const;
  void setText(const std::string& text, const std::string& called) const;
  void require() const;
  /// "a whole number from 1 to 8", "one of auto, fixed", "true or false".
  std::string allowed() const;
  /// For tables: "1 … 8", "auto, fixed", "-1 … 1 or auto"; empty where everything is allowed.
  std::string symbols() const;
};

/// As a person would type it: lists in brackets, texts without quotes.
std::string textOf(const Field::Value& value);

/// `rows` with `group` and a slash before their keys.
std::vector<Field> under(const std::string& group, std::vector<Field> rows);

/// All of `tables`, one after another.
std::vector<Field> joined(std::initializer_list<std::vector<Field>> tables);

/// The row of `key`, which is there.
const Field& fieldOf(const std::vector<Field>& rows, const std::string& key);

/// Throws as Field::require() for the first bad field of `options`.
template <typename Options>
void requireFields(Options options) {
  for (const Field& field : fieldsOf(options)) field.require();
}

}  // namespace sunlit
