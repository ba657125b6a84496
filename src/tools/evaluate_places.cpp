// How well places of one drive are found again in another, by several methods.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "sunlit/evaluate/places/place_comparison.h"
#include "sunlit/evaluate/places/place_files.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/columns.h"
#include "sunlit/studio/command_line.h"
#include "tools/output_folder.h"
#include "tools/progress_line.h"

namespace sunlit::tools {
namespace {

using evaluate::FoundPlaces;
using evaluate::PictureFolder;
using evaluate::PlaceComparison;
using evaluate::PlaceMethod;
using evaluate::PlaceRow;

struct PlacesOptions {
  std::string map;
  std::string queries;
  std::string output;
  std::vector<PlaceMethod> methods;
  std::size_t tolerance = 5;
  double features_cache_gb = evaluate::kUsualFeaturesCache_gb;
};

std::vector<Field> fieldsOf(PlacesOptions& options) {
  return {{"out", &options.output, "", {}, "gets places.csv, and of each method its matrix as PNG and CSV"},
          {"map", &options.map, "", {}, "pictures of the map in the order of their names, numbers as such"},
          {"query", &options.queries, "", {}, "likewise the pictures to be found in the map"},
          {"tolerance",
           &options.tolerance,
           "frames",
           {0, 1e9},
           "a place is true that lies at most so far from the query's own index"},
          evaluate::featuresCacheRow(&options.features_cache_gb)};
}

std::string methodNames() {
  std::string names;
  for (const PlaceMethod& method : evaluate::allPlaceMethods())
    names += (names.empty() ? "" : ", ") + method.name();
  return names;
}

/// Of a list by commas.
void addMethods(const std::string& option, const std::string& names, std::vector<PlaceMethod>* methods) {
  for (const std::string& name : splitAtCommas(names)) {
    const PlaceMethod method = evaluate::placeMethod(name, option);
    const bool is_there = std::any_of(methods->begin(), methods->end(), [&](const PlaceMethod& other) {
      return other.name() == method.name();
    });
    if (is_there) throw std::invalid_argument(option + " names " + method.name() + " twice");
    methods->push_back(method);
  }
}

std::optional<PlacesOptions> parse(const std::vector<std::string>& arguments) {
  PlacesOptions options;
  const std::vector<Field> rows = fieldsOf(options);
  studio::CommandLine line(
      "evaluate_places: how well places of one drive are found in another. Needs no ROS master.",
      "evaluate_places --out DIR --map DIR --query DIR --method NAME [options]");
  line.group("What is compared");
  line.add("--map DIR", fieldOf(rows, "map"));
  line.add("--query DIR", fieldOf(rows, "query"));
  line.add("--tolerance FRAMES", fieldOf(rows, "tolerance"));
  line.add("--method NAME[,NAME...]",
           {"method",
            OwnForm{},
            "",
            {},
            "one or more of " + methodNames() +
                ", vlad also of a detector behind a preprocessing, vlad:sift+clahe; may be repeated"})
      .then([&](const std::string& option, const std::string& names) {
        addMethods(option, names, &options.methods);
      });
  line.group("Output");
  line.add("--out DIR", fieldOf(rows, "out"));
  line.add("--features-cache-limit GB", fieldOf(rows, "features_cache_limit"));
  if (!line.read(arguments)) return std::nullopt;
  for (const std::string needed : {"--out DIR", "--map DIR", "--query DIR", "--method NAME"}) {
    if (!line.has(needed.substr(0, needed.find(' '))))
      throw std::invalid_argument(needed + " is missing; --help lists all options");
  }
  return options;
}

/// The progress line of one work after another.
class PlacesProgress {
 public:
  void show(const std::string& work, std::size_t done, std::size_t all) {
    if (work != work_) {
      line_.end();
      work_ = work;
      begin_ = Clock::now();
    }
    const double share = static_cast<double>(done) / static_cast<double>(all);
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    line_.show(work, share, spent_s / share - spent_s);
  }
  void end() { line_.end(); }

 private:
  using Clock = std::chrono::steady_clock;
  ProgressLine line_;
  std::string work_;
  Clock::time_point begin_;
};

/// `difference_vlad_sift`: a colon is no letter of a file's name everywhere.
std::string matrixName(const PlaceMethod& method) {
  std::string name = "difference_" + method.name();
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
}

void print(const std::vector<PlaceRow>& rows) {
  std::printf("%-12s %8s %9s %9s %9s %9s %9s\n", "method", "queries", "recall@1", "recall@5", "recall@10",
              "PR AUC", "R@100P");
  for (const PlaceRow& row : rows) {
    const evaluate::PlaceScores& scores = row.scores;
    std::printf("%-12s %8zu %9.3f %9.3f %9.3f %9.3f %9.3f\n", row.method.c_str(), scores.queries,
                scores.recall_1, scores.recall_5, scores.recall_10, scores.pr_auc,
                scores.recall_at_100_precision);
  }
}

void printOthers(const PictureFolder& pictures) {
  if (pictures.other_files > 0) {
    std::printf("%s: %zu files are no pictures and are not used\n", pictures.folder.c_str(),
                pictures.other_files);
  }
}

void printNotes(const std::string& method, const FoundPlaces& found, const evaluate::PlaceScores& scores) {
  for (const std::string& note : found.notes) std::printf("%s: %s\n", method.c_str(), note.c_str());
  if (scores.without_guess > 0)
    std::printf("%s: %zu queries found no place\n", method.c_str(), scores.without_guess);
}

/// Matrices are drawn as pictures: among those that are read they would be places of the next run.
void requireFolderOfItsOwn(const PlacesOptions& options) {
  for (const auto& [option, pictures] : {std::pair{"--map", &options.map}, {"--query", &options.queries}}) {
    std::error_code none;  // no such folder yet: another
    if (std::filesystem::equivalent(options.output, *pictures, none)) {
      refuse(
          "--out", '"' + options.output + '"',
          std::string("another folder than that of ") + option +
              ", in which a matrix that is drawn (difference_*.png) would be a place of the next run: give "
              "a new one, or one of results alone");
    }
  }
}

void evaluatePlaces(const PlacesOptions& options) {
  const PictureFolder map = evaluate::openPictureFolder(options.map);
  const PictureFolder queries = evaluate::openPictureFolder(options.queries);
  requireFolderOfItsOwn(options);
  requireFolderCanBeMade(options.output);
  PlacesProgress progress;
  PlaceComparison comparison(
      map, queries,
      [&](const std::string& work, std::size_t done, std::size_t all) { progress.show(work, done, all); },
      evaluate::FeatureCache::usual(options.features_cache_gb, [&](const std::string& note) {
        progress.end();
        std::fprintf(stderr, "evaluate_places: %s\n", note.c_str());
      }));
  for (const PlaceMethod& method : options.methods) comparison.require(method);
  printOthers(map);
  printOthers(queries);
  std::vector<PlaceRow> rows;
  for (const PlaceMethod& method : options.methods) {
    const FoundPlaces found = comparison.find(method);
    progress.end();
    rows.push_back({method.name(), placeScores(found.distances, found.guesses, options.tolerance)});
    image::makeFolder(options.output);
    const std::string file = options.output + "/" + matrixName(method);
    evaluate::writeMatrix(file + ".csv", found.distances, {queries.names, map.names});
    evaluate::drawMatrix(file + ".png", found.distances);
    printNotes(method.name(), found, rows.back().scores);
  }
  evaluate::writePlaces(options.output + "/places.csv", rows);
  if (rows[0].scores.without_truth > 0) {
    std::printf(
        "%zu queries have no true place within %zu frames: missed by every recall@N, not in PR's recall, but "
        "their guesses count against its precision\n",
        rows[0].scores.without_truth, options.tolerance);
  }
  print(rows);
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"evaluate_places", argc, argv}, parse, evaluatePlaces);
}
