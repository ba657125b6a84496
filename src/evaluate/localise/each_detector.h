/// What several detectors do with several views.
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::evaluate {

/// work(view, detector) of each two, in parallel, and what they threw.
template <typename Work>
DetectorFaults forEachDetector(const std::vector<PosedView>& views, const std::vector<std::string>& detectors,
                               const Work& work) {
  std::vector<std::string> thrown(views.size() * detectors.size());
  tbb::parallel_for(std::size_t{0}, thrown.size(), [&](std::size_t task) {
    const std::size_t detector = task % detectors.size();
    try {
      work(task / detectors.size(), detector);
    } catch (const std::exception& error) {
      thrown[task] = detectors[detector] + ": " + reasonInWords(error);
    }
  });
  DetectorFaults faults;
  for (std::size_t task = 0; task < thrown.size(); ++task) {
    if (!thrown[task].empty()) faults[{task / detectors.size(), task % detectors.size()}] = thrown[task];
  }
  return faults;
}

}  // namespace sunlit::evaluate
