#include "sunlit/quantity/field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "sunlit/quantity/columns.h"
#include "sunlit/quantity/comma_list.h"

namespace sunlit {
namespace {

template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

using Value = Field::Value;

/// In messages texts stand in quotes.
std::string quoted(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return '"' + *text + '"';
  return textOf(value);
}

/// "a number from 1 to 10 m", or "a number in m", where `kind` is "a number".
std::string within(const std::string& kind, const Field& field) {
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  if (field.range.symbols().empty()) return kind + (unit.empty() ? "" : " in" + unit);
  return kind + " " + field.range.words() + unit;
}

/// "1e1" and "1.5e3" are texts by YAML 1.1, which rosparam reads: it knows no exponent but behind a point,
/// and with a sign.
std::optional<double> numberWithExponent(const std::string& text) {
  if (text.find_first_of("eE") == std::string::npos) return std::nullopt;
  if (text.find_first_not_of("+-.0123456789eE") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<double> numberIn(const Value& value) {
  if (const auto* whole = std::get_if<int>(&value)) return *whole;
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* text = std::get_if<std::string>(&value)) return numberWithExponent(*text);
  return std::nullopt;
}

std::optional<std::size_t> indexOf(const Choice& choice, const Value& value) {
  // YAML takes the words on and off for true and false (YAML 1.1, bool).
  std::string word;
  if (const auto* truth = std::get_if<bool>(&value)) word = *truth ? "on" : "off";
  if (const auto* text = std::get_if<std::string>(&value)) word = *text;
  for (std::size_t i = 0; i < choice.words.size(); ++i) {
    if (choice.words[i] == word) return i;
  }
  return std::nullopt;
}

/// A number within the range, or a refusal.
double checked(const Field& field, const Value& value, const std::string& called) {
  const std::optional<double> number = numberIn(value);
  if (!number) refuse(called, quoted(value), field.allowed());
  require(called, *number, field.range, field.unit);
  return *number;
}

/// Of a range, where the row gives none, that the type can hold.
template <typename Whole>
Whole checkedWhole(const Field& field, const Value& value, const std::string& called) {
  const double number = checked(field, value, called);
  if (number != std::floor(number)) refuse(called, textOf(number), field.allowed());
  constexpr double kExact = 9007199254740992.0;  // beyond it a double skips whole numbers
  const Range held{std::max<double>(-kExact, std::numeric_limits<Whole>::min()),
                   std::min<double>(kExact, std::numeric_limits<Whole>::max())};
  require(called, number, held, field.unit);
  return static_cast<Whole>(number);
}

template <typename Type>
Type checkedType(const Field& field, const Value& value, const std::string& called) {
  const Type* typed = std::get_if<Type>(&value);
  if (typed == nullptr) refuse(called, quoted(value), field.allowed());
  return *typed;
}

/// Some of the words, each once.
std::vector<std::string> checkedWords(const Field& field, const Choices& choices, const Value& value,
                                      const std::string& called) {
  const auto given = checkedType<std::vector<std::string>>(field, value, called);
  const auto isGood = [&](const std::string& word) {
    return std::count(choices.words.begin(), choices.words.end(), word) == 1 &&
           std::count(given.begin(), given.end(), word) == 1;
  };
  if ((given.empty() && !choices.may_be_empty) || !std::all_of(given.begin(), given.end(), isGood))
    refuse(called, textOf(value), field.allowed());
  return given;
}

}  // namespace

std::string textOf(const Value& value) {
  return std::visit(
      Overloaded{[](bool flag) { return std::string(flag ? "true" : "false"); },
                 [](int whole) { return std::to_string(whole); },
                 [](double number) { return textOf(number, 15); },
                 [](const std::string& text) { return text; },
                 [](const std::vector<std::string>& list) { return "[" + commaList(list) + "]"; }},
      value);
}

Value Field::value() const {
  return std::visit(Overloaded{[](const double* number) { return Value(*number); },
                               [](const Angle* angle) { return Value(angle->deg()); },
                               [](const int* whole) { return Value(*whole); },
                               [](const std::int64_t* whole) { return Value(static_cast<double>(*whole)); },
                               [](const std::size_t* count) { return Value(static_cast<double>(*count)); },
                               [](const bool* flag) { return Value(*flag); },
                               [](const std::string* text) { return Value(*text); },
                               [](const std::vector<std::string>* list) { return Value(*list); },
                               [](const Choice& choice) { return Value(choice.words.at(choice.get())); },
                               [](const Choices& choices) { return Value(choices.get()); },
                               [](const NumberOrWord& either) {
                                 return *either.number ? Value(**either.number) : Value(either.word);
                               },
                               [](const OwnForm& own) { return Value(own.present); }},
                    place);
}

std::string Field::text() const {
  return textOf(value());
}

void Field::set(const Value& value, const std::string& called) const {
  std::visit(
      Overloaded{[&](double* number) { *number = checked(*this, value, called); },
                 [&](Angle* angle) { *angle = Angle::degrees(checked(*this, value, called)); },
                 [&](int* whole) { *whole = checkedWhole<int>(*this, value, called); },
                 [&](std::int64_t* whole) { *whole = checkedWhole<std::int64_t>(*this, value, called); },
                 [&](std::size_t* count) { *count = checkedWhole<std::size_t>(*this, value, called); },
                 [&](bool* flag) { *flag = checkedType<bool>(*this, value, called); },
                 [&](std::string* text) { *text = checkedType<std::string>(*this, value, called); },
                 [&](std::vector<std::string>* list) {
                   *list = checkedType<std::vector<std::string>>(*this, value, called);
                 },
                 [&](const Choice& choice) {
                   const auto index = indexOf(choice, value);
                   if (!index) refuse(called, quoted(value), allowed());
                   choice.set(*index);
                 },
                 [&](const Choices& choices) { choices.set(checkedWords(*this, choices, value, called)); },
                 [&](const NumberOrWord& either) {
                   const auto* word = std::get_if<std::string>(&value);
                   const bool none = word != nullptr && *word == either.word;
                   *either.number =
                       none ? std::nullopt : std::optional<double>(checked(*this, value, called));
                 },
                 [](const OwnForm&) { assert(false && "read elsewhere"); }},
      place);
}

void Field::setText(const std::string& text, const std::string& called) const {
  if (std::holds_alternative<std::string*>(place) || std::holds_alternative<Choice>(place))
    return set(text, called);
  if (std::holds_alternative<bool*>(place))
    return text == "true" || text == "false" ? set(text == "true", called) : set(text, called);
  if (std::holds_alternative<Choices>(place)) return set(splitAtCommas(text), called);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0' && std::isfinite(number);
  return is_number ? set(number, called) : set(text, called);
}

void Field::require() const {
  // In radians, so that rounding does not carry an angle at the end of its range out of it.
  if (const Angle* const* angle = std::get_if<Angle*>(&place)) {
    const double rad = (*angle)->rad();
    if (rad == Angle::degrees(range.low).rad() || rad == Angle::degrees(range.high).rad()) return;
  }
  if (!std::holds_alternative<OwnForm>(place)) set(value(), key);
}

std::string Field::allowed() const {
  return std::visit(
      Overloaded{
          [](const bool*) { return std::string("true or false"); },
          [](const std::string*) { return std::string("text"); },
          [](const std::vector<std::string>*) { return std::string("a list of words, [a, b]"); },
          [](const Choice& choice) { return "one of " + commaList(choice.words); },
          [](const Choices& choices) {
            return "a list of some of " + commaList(choices.words) + ", each once" +
                   (choices.may_be_empty ? ", or []" : "");
          },
          [&](const NumberOrWord& either) { return within('"' + either.word + "\" or a number", *this); },
          [&](const OwnForm&) { return doc; }, [&](const int*) { return within("a whole number", *this); },
          [&](const std::int64_t*) { return within("a whole number", *this); },
          [&](const std::size_t*) { return within("a whole number", *this); },
          [&](const auto*) { return within("a number", *this); }},
      place);
}

std::string Field::symbols() const {
  if (const auto* choice = std::get_if<Choice>(&place)) return commaList(choice->words);
  if (const auto* choices = std::get_if<Choices>(&place)) return commaList(choices->words);
  const auto* either = std::get_if<NumberOrWord>(&place);
  return range.symbols() + (either == nullptr ? "" : " or " + either->word);
}

std::vector<Field> under(const std::string& group, std::vector<Field> rows) {
  for (Field& row : rows) row.key = group + '/' + row.key;
  return rows;
}

std::vector<Field> joined(std::initializer_list<std::vector<Field>> tables) {
  std::vector<Field> all;
  for (const std::vector<Field>& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

const Field& fieldOf(const std::vector<Field>& rows, const std::string& key) {
  for (const Field& row : rows) {
    if (row.key == key) return row;
  }
  assert(false && "no such field");
  std::abort();
}

}  // namespace sunlit
