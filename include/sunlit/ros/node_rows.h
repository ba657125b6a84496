/// Rows of parameters that several nodes have.
#pragma once

#include "sunlit/quantity/field.h"

namespace sunlit::ros_interface {

/// Of `~conditions`, which readConditions() reads.
inline Field conditionsRow() {
  return {"conditions",
          OwnForm{""},
          "",
          {},
          "a list of names, [morning, noon], or a map from names to what differs, "
          "{h04: {hour: 4}, h12: {hour: 12}}"};
}

/// Of `~diagnostic_period`, which diagnostic_updater reads by itself; it is kept at `period_s` to be checked.
inline Field diagnosticPeriodRow(double* period_s) {
  return {"diagnostic_period", period_s, "s", {0.01, 3600}, "between diagnostics, by the wall clock"};
}

}  // namespace sunlit::ros_interface
