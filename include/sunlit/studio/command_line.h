/// A program's command line: options that are rows, read, checked and explained by them. In a library of its
/// own, sunlit_command_line, so that programs need no more of the studio.
#pragma once

#include <cstddef>
#include <cstdio>
#include <deque>
#include <exception>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sunlit/image/files.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::studio {

/// One option: a row, or several whose values are typed in one word, such as "30,4".
class Option {
 public:
  /// Looks at a value that the rows have taken, or reads one of a row that is an OwnForm.
  using Then = std::function<void(const std::string& option, const std::string& value)>;

  /// `form` as --help shows it: "--fov DEG", or with a part for each row "--site LAT,LON[,ELEVATION]", whose
  /// parts in brackets may be left out and are 0 then. Parts stand apart by ',', or what makes WxH or HH:MM.
  /// Of a Choice the name is enough: its words tell what may follow; and of what is true or false, if nothing
  /// follows.
  Option(const std::string& form, std::string doc, std::vector<Field> rows);

  Option& then(Then then);
  /// What happens without it is not what its rows hold, so that --help tells no default.
  Option& withoutDefault();

  const std::string& name() const { return name_; }  ///< with its dashes
  /// Takes no value: that it is there sets its row, which is true or false.
  bool isFlag() const { return form_.empty() && std::holds_alternative<bool*>(rows_[0].place); }
  const std::string& form() const { return form_; }  ///< of the value
  /// In one line: meaning, unit, range, default.
  const std::string& help() const { return help_; }
  /// Throws std::invalid_argument naming option, value and what is allowed.
  void take(const std::string& value) const;

 private:
  void takeParts(const std::string& value) const;
  std::string explained(const std::string& default_text) const;
  std::string usual() const;

  std::string name_, form_, doc_;
  std::vector<Field> rows_;
  char separator_ = ',';
  std::size_t least_ = 1;  ///< of parts
  std::string help_;
  Then then_;
};

class CommandLine {
 public:
  /// `about` is the first line of --help, `usage` the one below.
  CommandLine(std::string about, std::string usage);

  /// Those added from here on stand below this heading.
  void group(const std::string& heading);
  /// An option as its row explains it. What the rows point to must stay where it is until read() is done.
  Option& add(const std::string& form, const Field& row);
  Option& add(const std::string& form, const std::string& doc, std::vector<Field> rows);

  /// Words that belong to no option, as A and B in "usage: tool --out DIR A B", are put behind `*words` in
  /// their order. Without this there are none.
  void takeWords(std::vector<std::string>* words);

  /// Lets each option take its value, in their order; of one that is given twice the last counts, unless it
  /// collects. False once --help has printed what there is. Throws std::invalid_argument for an option that
  /// there is not, whole, for one without a value, or with an empty one, and what Option::take() throws.
  bool read(const std::vector<std::string>& arguments);

  /// What read() took, as typed, in its order: "--fov" and "60".
  const std::vector<std::pair<std::string, std::string>>& given() const { return given_; }
  bool has(const std::string& option) const;
  /// Throws std::invalid_argument where `option` is given, but none of `others`.
  void requireWith(const std::string& option, const std::vector<std::string>& others) const;

 private:
  struct Group {
    std::string heading;
    std::deque<Option> options;  ///< which stay where they are
  };
  const Option* find(const std::string& name) const;  ///< null where there is none

  std::string about_, usage_;
  std::deque<Group> groups_;
  std::vector<std::string>* words_ = nullptr;
  std::vector<std::pair<std::string, std::string>> given_;
};

/// A copy of `row` with another meaning for those who read --help.
Field explainedAs(Field row, std::string doc);

/// `file` can be written: it ends in `ending`, such as ".png", since what is written is of that kind,
/// whatever the name; and its folder is there, which is better known before the work than after it. All
/// throw as Option::take() does.
void requireFile(const std::string& option, const std::string& file, const std::string& ending);
void requireEnding(const std::string& option, const std::string& file, const std::string& ending);
void requireFolderOf(const std::string& option, const std::string& file);

/// What main() is called with, and the program's name.
struct Called {
  const char* name;
  int argc;
  char** argv;
};

/// The main() of a program. `parse` makes an optional of its options from the arguments, empty if help was
/// asked for. The status is what `run` returns, 0 if it returns nothing, and 1, with one line and the
/// program's name, for what `parse` or `run` throws.
template <typename Parse, typename Run>
int runProgram(const Called& called, const Parse& parse, const Run& run) {
  image::prepareProcess();
  keepFreedMemory();
  try {
    const auto options = parse(std::vector<std::string>(called.argv + 1, called.argv + called.argc));
    if (!options) return 0;
    if constexpr (std::is_void_v<decltype(run(*options))>) {
      run(*options);
      return 0;
    } else {
      return run(*options);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", called.name, reasonInWords(error).c_str());
    return 1;
  }
}

}  // namespace sunlit::studio
