#include "sunlit/evaluate/run/localisation_of_run.h"

#include <sstream>

namespace sunlit::evaluate {

std::vector<Field> fieldsOf(LocalisationOfRun& options, const ComparerOptions& comparer) {
  LocalisationOfRun* const all = &options;
  const ComparerOptions* const compared = &comparer;
  const Choices detectors{comparer.known.namesOfDetectors(),
                          [all, compared] { return localisingDetectors(*all, *compared); },
                          [all](const std::vector<std::string>& some) { all->detectors = some; }, true};
  std::vector<Field> rows =
      joined({{{"map",
                &options.map,
                "",
                {},
                "stream whose images, with depth and poses, make a map that the others are looked for in "
                "once all is evaluated, or several, h04+h12; empty: nothing is localised"},
               {"queries",
                &options.queries,
                "",
                {},
                "streams that are looked for; [] for all others that are in a pair"},
               {"detectors",
                detectors,
                "",
                {},
                "among the differences; without this key sift and orb, where they are"}},
              {mapEveryRow(&options.map_every_m)},
              fieldsOf(options.localiser)});
  for (Field& row : rows) row.key = "localisation/" + row.key;
  return rows;
}

std::vector<std::string> localisingDetectors(const LocalisationOfRun& options,
                                             const ComparerOptions& comparer) {
  return options.detectors ? *options.detectors : usualDetectors(comparer);
}

std::vector<std::string> mapStreamsOf(const LocalisationOfRun& options) {
  std::vector<std::string> streams;
  std::istringstream text(options.map);
  for (std::string stream; std::getline(text, stream, '+');) streams.push_back(stream);
  return streams;
}

}  // namespace sunlit::evaluate
