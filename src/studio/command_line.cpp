#include "sunlit/studio/command_line.h"

#include <algorithm>
#include <boost/program_options.hpp>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <variant>

namespace sunlit::studio {

namespace {

namespace po = boost::program_options;

constexpr unsigned kLineLength = 120;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string joinedBy(const std::string& separator, const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    text += (text.empty() ? "" : separator) + part;
  }
  return text;
}

[[noreturn]] void rejectMissingValue(const std::string& option) {
  throw std::invalid_argument(option + " needs a value; --help lists all options");
}

/// "0.1 … 170 deg"; nothing of words, which the form tells.
std::string rangeOf(const Field& row) {
  return std::holds_alternative<Choice>(row.place) ? "" : joinedBy(" ", {row.range.symbols(), row.unit});
}

/// "A (B)", or one of both alone.
std::string withBrackets(const std::string& text, const std::string& more) {
  return joinedBy(" ", {text, more.empty() ? "" : "(" + more + ")"});
}

}  // namespace

Option::Option(const std::string& form, std::string doc, std::vector<Field> rows)
    : name_(form.substr(0, form.find(' '))),
      form_(form.substr(std::min(form.size(), name_.size() + 1))),
      doc_(std::move(doc)),
      rows_(std::move(rows)) {
  if (const auto* choice = std::get_if<Choice>(&rows_[0].place)) form_ = joinedBy("|", choice->words);
  if (rows_.size() > 1) {
    separator_ = form_[form_.find_first_of(",:x")];
    const std::string needed = form_.substr(0, form_.find('['));
    least_ = 1 + static_cast<std::size_t>(std::count(needed.begin(), needed.end(), separator_));
  }
  const std::string default_text = isFlag() ? "" : usual();
  help_ = explained(default_text.empty() ? "" : "default " + default_text);
}

Option& Option::then(Then then) {
  then_ = std::move(then);
  return *this;
}

Option& Option::withoutDefault() {
  help_ = explained("");
  return *this;
}

std::string Option::explained(const std::string& default_text) const {
  if (rows_.size() == 1) return withBrackets(doc_, joinedBy(", ", {rangeOf(rows_[0]), default_text}));
  std::vector<std::string> parts;
  for (const Field& row : rows_)
    parts.push_back(withBrackets(row.key, joinedBy(", ", {row.doc, rangeOf(row)})));
  return withBrackets(joinedBy(": ", {doc_, joinedBy(", ", parts)}), default_text);
}

std::string Option::usual() const {
  std::vector<std::string> parts;
  for (const Field& row : rows_) {
    if (const auto* choices = std::get_if<Choices>(&row.place)) {
      parts.push_back(joinedBy(",", choices->get()));
    } else if (!std::holds_alternative<std::vector<std::string>*>(row.place)) {
      parts.push_back(row.text());
    }
  }
  return joinedBy(std::string(1, separator_), parts);
}

void Option::take(const std::string& value) const {
  if (rows_.size() > 1) {
    takeParts(value);
  } else if (auto* const* list = std::get_if<std::vector<std::string>*>(&rows_[0].place)) {
    (*list)->push_back(value);
  } else if (!std::holds_alternative<OwnForm>(rows_[0].place)) {
    rows_[0].setText(value, name_);
  }
  if (then_) then_(name_, value);
}

void Option::takeParts(const std::string& value) const {
  const std::string quoted = '"' + value + '"';
  const std::vector<std::string> parts = split(value, separator_);
  if (parts.size() < least_ || parts.size() > rows_.size()) {
    const std::string least = least_ == rows_.size() ? "" : std::to_string(least_) + " to ";
    refuse(name_, quoted,
           least + std::to_string(rows_.size()) + " numbers separated by '" + separator_ + "': " + form_);
  }
  try {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      rows_[i].setText(i < parts.size() ? parts[i] : "0", rows_[i].key);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name_ + " is " + quoted + ": " + error.what());
  }
}

CommandLine::CommandLine(std::string about, std::string usage)
    : about_(std::move(about)), usage_(std::move(usage)) {}

void CommandLine::group(const std::string& heading) {
  groups_.push_back({heading, {}});
}

Option& CommandLine::add(const std::string& form, const Field& row) {
  return add(form, row.doc, {row});
}

Option& CommandLine::add(const std::string& form, const std::string& doc, std::vector<Field> rows) {
  if (groups_.empty()) group("Options");
  groups_.back().options.emplace_back(form, doc, std::move(rows));
  return groups_.back().options.back();
}

void CommandLine::takeWords(std::vector<std::string>* words) {
  words_ = words;
}

bool CommandLine::has(const std::string& option) const {
  return std::any_of(given_.begin(), given_.end(), [&](const auto& pair) { return pair.first == option; });
}

void CommandLine::requireWith(const std::string& option, const std::vector<std::string>& others) const {
  if (!has(option)) return;
  if (std::any_of(others.begin(), others.end(), [&](const std::string& other) { return has(other); })) return;
  throw std::invalid_argument(option + " needs " + joinedBy(" or ", others) + " too");
}

const Option* CommandLine::find(const std::string& name) const {
  for (const Group& group : groups_) {
    for (const Option& option : group.options) {
      if (option.name() == name) return &option;
    }
  }
  return nullptr;
}

namespace {

po::options_description described(const std::string& heading, const std::deque<Option>& options) {
  po::options_description described(heading, kLineLength, kLineLength / 2);
  for (const Option& option : options) {
    const std::string name = option.name().substr(2);
    if (option.isFlag()) {
      described.add_options()(name.c_str(), option.help().c_str());
      continue;
    }
    auto* const value = po::value<std::string>()->value_name(option.form());
    described.add_options()(name.c_str(), value, option.help().c_str());
  }
  return described;
}

/// What was typed, in its order.
struct Typed {
  std::string name;  ///< of an option; of one that is unknown, and of a word that is none, as it was typed
  std::string value;
  bool is_word = false;  ///< and no option
};

std::vector<Typed> typedWords(const std::vector<std::string>& arguments,
                              const po::options_description& known) {
  constexpr int kWholeNames = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  std::vector<Typed> words;
  try {
    const auto parsed =
        po::command_line_parser(arguments).options(known).style(kWholeNames).allow_unregistered().run();
    for (const po::option& option : parsed.options) {
      const bool is_known = !option.unregistered && !option.string_key.empty();
      words.push_back({is_known ? "--" + option.string_key : option.original_tokens.at(0),
                       option.value.empty() ? std::string() : option.value[0], option.string_key.empty()});
    }
  } catch (const po::invalid_command_line_syntax& error) {
    if (error.kind() == po::invalid_syntax::extra_parameter)
      throw std::invalid_argument(error.get_option_name() + " takes no value; --help lists all options");
    rejectMissingValue(error.get_option_name());
  }
  return words;
}

}  // namespace

bool CommandLine::read(const std::vector<std::string>& arguments) {
  po::options_description known(kLineLength, kLineLength / 2);
  known.add_options()("help,h", "explains all options");
  for (const Group& group : groups_) known.add(described(group.heading, group.options));
  for (const auto& [name, value, is_word] : typedWords(arguments, known)) {
    if (name == "--help") {
      std::ostringstream text;
      text << about_ << "\n\nusage: " << usage_ << "\n\n" << known;
      std::fputs(text.str().c_str(), stdout);
      return false;
    }
    if (is_word && words_ != nullptr) {
      words_->push_back(name);
      continue;
    }
    const Option* const option = find(name);
    if (option == nullptr) throw std::invalid_argument("there is no option " + name + "; --help lists all");
    if (option->isFlag()) {
      option->take("true");
      given_.emplace_back(name, "true");
      continue;
    }
    if (value.empty() || value == "--help" || find(value) != nullptr) rejectMissingValue(name);
    option->take(value);
    given_.emplace_back(name, value);
  }
  return true;
}

Field explainedAs(Field row, std::string doc) {
  row.doc = std::move(doc);
  return row;
}

void requireEnding(const std::string& option, const std::string& file, const std::string& ending) {
  const bool ends = file.size() > ending.size() &&
                    file.compare(file.size() - ending.size(), std::string::npos, ending) == 0;
  if (!ends) refuse(option, '"' + file + '"', "a name that ends in " + ending);
}

void requireFile(const std::string& option, const std::string& file, const std::string& ending) {
  requireEnding(option, file, ending);
  requireFolderOf(option, file);
}

void requireFolderOf(const std::string& option, const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    refuse(option, '"' + file + '"', "in a folder that exists");
}

}  // namespace sunlit::studio
