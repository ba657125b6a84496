#include "evaluate/run/run_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core/version.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "evaluate/files/files.h"
#include "sunlit/evaluate/run/run_folder.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/yaml_text.h"

namespace sunlit::evaluate {
namespace {

const std::string kAbout = "about/";  ///< stands before the keys of EvaluationOptions::about

// A key of about may be any text.
std::string keyText(const std::string& key) {
  const bool is_plain = std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '/' || c == '-' || c == '.');
  });
  return is_plain ? key : yamlQuoted(key);
}

// Only what writeRunFile() writes: lines of two spaces, key, colon, space, value in quotes.
std::map<std::string, std::string> settingsIn(const std::string& path) {
  std::map<std::string, std::string> settings;
  std::ifstream file(path);
  bool is_in_settings = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("  ", 0) != 0) {
      is_in_settings = line == "settings:";
      continue;
    }
    if (!is_in_settings) continue;
    std::size_t at = 2;
    const bool is_quoted = line.size() > 2 && (line[2] == '\'' || line[2] == '"');
    const std::string quoted_key = is_quoted ? yamlUnquoted(line, &at) : "";
    const std::size_t colon = line.find(": ", at);
    if (colon == std::string::npos) continue;
    at = colon + 2;
    settings[is_quoted ? quoted_key : line.substr(2, colon - 2)] = yamlUnquoted(line, &at);
  }
  return settings;
}

bool isMark(char c) {
  return c != '\0' && std::strchr("[]{}(),:;", c) != nullptr;
}

/// Of a value as people type it: words, numbers, marks and blanks, but for those beside marks.
std::vector<std::string> wordsIn(const std::string& text) {
  std::vector<std::string> words;
  bool goes_on = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t next = std::min(text.find_first_not_of(' ', i), text.size());
    const bool is_beside_mark =
        next > i && ((!words.empty() && isMark(words.back()[0])) || isMark(text[next]));
    if (is_beside_mark) {
      i = next - 1;
      goes_on = false;
      continue;
    }
    const bool is_apart = text[i] == ' ' || isMark(text[i]);
    if (!goes_on || is_apart) words.emplace_back();
    words.back() += text[i];
    goes_on = !is_apart;
  }
  return words;
}

std::optional<double> numberIn(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  return *end == '\0' && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Values that are spelt otherwise are the same: [5,13] and [5, 13.0].
bool areTheSame(const std::string& a, const std::string& b) {
  const std::vector<std::string> a_words = wordsIn(a), b_words = wordsIn(b);
  return std::equal(a_words.begin(), a_words.end(), b_words.begin(), b_words.end(),
                    [](const std::string& one, const std::string& other) {
                      return one == other || (numberIn(one) && numberIn(one) == numberIn(other));
                    });
}

std::string listText(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + yamlQuoted(name);
  return "[" + list + "]";
}

std::string countersText(const EvaluationOptions& options, const Outcome& outcome,
                         const LocalisationOutcome* localised) {
  std::ostringstream text;
  text << "outcome:\n  whole: " << (outcome.isWhole() ? "true" : "false")
       << "\n  completed_poses: " << outcome.counts.completed_poses
       << "\n  absent_poses: " << outcome.absent_poses << "\n  not_mended: " << outcome.not_mended
       << "\n  unexpected_poses: " << outcome.counts.unexpected_poses;
  if (localised != nullptr)
    text << "\n  key_frames: " << localised->key_frames << "\n  not_mapped: " << localised->unmapped
         << "\n  not_localised: " << localised->unobserved
         << "\n  unplaced: " << listText(localised->unplaced);
  text << "\ncounters:\n  streams:\n";
  for (std::size_t i = 0; i < options.streams.size(); ++i) {
    const StreamCounts& c = outcome.counts.streams[i];
    text << "    " << yamlQuoted(options.streams[i]) << ": {received: " << c.received
         << ", duplicate: " << c.duplicate << ", out_of_order: " << c.out_of_order
         << ", undecodable: " << c.undecodable << ", late: " << c.late << ", dropped: " << c.dropped
         << ", lost: " << c.lost << ", unexpected: " << c.unexpected << ", lossy: " << c.lossy
         << ", no_features: " << c.no_features << ", other_sun: " << c.other_sun
         << ", unlocalised: " << c.unlocalised << "}\n";
  }
  text << "  pairs:\n";
  for (std::size_t i = 0; i < options.pairs.size(); ++i) {
    const PairCounts& c = outcome.counts.pairs[i];
    text << "    " << yamlQuoted(options.pairs[i].name()) << ": {evaluated: " << c.evaluated
         << ", resumed: " << c.resumed << ", missing_partner: " << c.missing_partner
         << ", undecodable: " << c.undecodable << ", size_mismatch: " << c.size_mismatch
         << ", dropped: " << c.dropped << ", failed: " << c.failed << ", unplaced: " << c.unplaced
         << ", duplicate: " << c.duplicate << ", other_sun: " << c.other_sun
         << ", two_places: " << c.two_places << "}\n";
  }
  return text.str();
}

}  // namespace

Settings settingsOf(const EvaluationOptions& options) {
  Settings settings;
  EvaluationOptions present = options;
  for (const Field& field : decidingFieldsOf(present)) settings.emplace_back(field.key, field.text());
  for (const auto& item : options.about) settings.emplace_back(kAbout + item.first, item.second);
  return settings;
}

bool holdsSettings(const std::string& path) {
  return !settingsIn(path).empty();
}

void requireSameSettings(const std::string& path, const Settings& settings) {
  const std::map<std::string, std::string> old_settings = settingsIn(path);
  if (old_settings.empty()) return;
  // One line, whatever they hold.
  const auto shown = [](const std::string& text) {
    const std::string quoted = yamlQuoted(text);
    return quoted[0] == '"' ? quoted : text;
  };
  const auto refuse = [&](const std::string& key, const std::string& was, const std::string& is) {
    throw std::invalid_argument(path + ": this folder holds a run with another setting: " + shown(key) +
                                " was " + shown(was) + ", now " + shown(is) +
                                "; choose another output_dir, or the setting that it was made with");
  };
  std::map<std::string, std::string> current(settings.begin(), settings.end());
  // What a person typed first: other settings may follow from it.
  Settings ordered = settings;
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const auto& item) { return item.first.rfind(kAbout, 0) == 0; });
  for (const auto& item : ordered) {
    const auto found = old_settings.find(item.first);
    if (found == old_settings.end()) refuse(item.first, "not given", item.second);
    if (!areTheSame(found->second, item.second)) refuse(item.first, found->second, item.second);
  }
  for (const auto& item : old_settings) {
    if (current.count(item.first) == 0) refuse(item.first, item.second, "not given");
  }
}

namespace {

bool hasRows(const std::string& csv) {
  std::ifstream file(csv);
  std::string heading, row;
  return std::getline(file, heading) && std::getline(file, row);
}

bool holdsAnyFile(const std::string& folder) {
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none)) {
    if (!entry.is_directory()) return true;
  }
  return false;
}

}  // namespace

bool holdsResults(const std::string& folder) {
  for (const char* name : {"/frames.csv", "/captures.csv", "/path.csv"}) {
    if (hasRows(folder + name)) return true;
  }
  return holdsAnyFile(folder + "/images");
}

void requireNoRun(const std::string& folder) {
  if (holdsSettings(folder + "/run.yaml") && holdsResults(folder))
    throw std::invalid_argument(folder +
                                ": this folder holds the results of an evaluation (run.yaml), which would be "
                                "mixed with those of others; choose another");
}

void claimFolder(const std::string& folder, const Settings& settings) {
  try {
    requireSameSettings(folder + "/run.yaml", settings);
  } catch (const std::invalid_argument&) {
    if (holdsResults(folder)) throw;
    for (const char* name :
         {"/run.yaml", "/problems.csv", "/summary.csv", "/verified.csv", "/verified_summary.csv",
          "/comparisons.csv", "/lost_features.bin", "/lost_features.csv"})
      std::filesystem::remove(folder + name);
  }
}

void writeRunFile(const std::string& path, const EvaluationOptions& options, const Outcome* outcome,
                  const LocalisationOutcome* localised) {
  std::string text =
      "# Settings decide the values; a folder is only taken up again with the same ones.\nsettings:\n";
  for (const auto& item : settingsOf(options))
    text += "  " + keyText(item.first) + ": " + yamlQuoted(item.second) + "\n";
  text += "poses: " + std::to_string(options.poses.count) +
          "\nfirst_pose: " + std::to_string(options.poses.first) +
          "\npose_stride: " + std::to_string(options.poses.stride) + "\n";
  text += std::string("versions:\n  sunlit: ") + yamlQuoted(SUNLIT_VERSION) +
          "\n  opencv: " + yamlQuoted(CV_VERSION) + "\n";
  if (outcome != nullptr) text += countersText(options, *outcome, localised);
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
