/// Between the dates that people type and instants.
#pragma once

#include <cstdint>

#include "sunlit/quantity/instant.h"

namespace sunlit::astronomy {

/// A day in a fixed time zone; same calendar and ranges as CivilDateTime.
struct CivilDate {
  int year = 2024;
  int month = 7;
  int day = 1;
  double timezone = 0.0;  ///< h east of UTC
};

/// Days of a month, 28 … 31. October 1582 is called 31 days long, although 5 to 14 do not exist.
int daysInMonth(int year, int month);

/// The whole Julian day number that begins at noon of a date of any year from −4712 on. Julian calendar until
/// 4 October 1582, Gregorian from 15 October 1582. Reda & Andreas (2008), eq. 4, in whole numbers. Checks
/// nothing.
std::int64_t julianDayNumber(int year, int month, int day);

/// The instant at which a clock in that time zone shows `civil`. To 1 ns. Throws std::invalid_argument naming
/// the field, its value and what is allowed, for anything out of range, a day that the month lacks, or NaN.
Instant instantOf(const CivilDateTime& civil);

/// The first instant of a local day. Throws as instantOf().
Instant midnightOf(const CivilDate& date);

/// What a clock in that time zone shows. `timezone` in h; any instant from JD 0 on.
CivilDateTime civilOf(const Instant& instant, double timezone);

}  // namespace sunlit::astronomy
