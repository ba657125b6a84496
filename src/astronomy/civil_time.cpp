#include "sunlit/astronomy/civil_time.h"

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

namespace sunlit::astronomy {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1000000000LL;
constexpr std::int64_t kNanosecondsPerHour = 3600LL * kNanosecondsPerSecond;
constexpr std::int64_t kNanosecondsPerNoon = Instant::kNanosecondsPerDay / 2;
constexpr std::int64_t kFirstGregorianDay = 2299161;  // 15 October 1582

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

bool isGregorian(int year, int month, int day) {
  if (year != 1582) return year > 1582;
  return month != 10 ? month > 10 : day >= 15;
}

bool isLeapYear(int year) {
  if (year % 4 != 0) return false;
  return year <= 1582 || year % 100 != 0 || year % 400 == 0;
}

std::int64_t timezoneNanoseconds(double timezone) {
  return std::llround(timezone * static_cast<double>(kNanosecondsPerHour));
}

void requireAll(std::initializer_list<const char*> keys, CivilDateTime civil) {
  const std::vector<Field> rows = fieldsOf(civil);
  for (const char* key : keys) fieldOf(rows, key).require();
}

void requireDate(const CivilDate& date) {
  const CivilDateTime civil{date.year, date.month, date.day, 0, 0, 0.0, date.timezone};
  requireAll({"year", "month"}, civil);
  const int last = daysInMonth(date.year, date.month);
  if (date.day < 1 || date.day > last) {
    refuse("day", std::to_string(date.day),
           "from 1 to " + std::to_string(last) + " in month " + std::to_string(date.month) + " of year " +
               std::to_string(date.year));
  }
  if (date.year == 1582 && date.month == 10 && date.day > 4 && date.day < 15) {
    refuse("day", std::to_string(date.day),
           "from 1 to 4 or from 15 to 31 in month 10 of year 1582, when the Gregorian calendar left out ten "
           "days");
  }
  requireAll({"timezone"}, civil);
}

void requireClock(const CivilDateTime& civil) {
  const bool end_of_day = civil.hour == 24 && civil.minute == 0 && civil.second == 0.0;
  if (!end_of_day) requireAll({"hour", "minute", "second"}, civil);
}

}  // namespace

int daysInMonth(int year, int month) {
  if (month == 2) return isLeapYear(year) ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

std::int64_t julianDayNumber(int year, int month, int day) {
  // January and February count as months 13 and 14 of the year before, so that the leap day comes last.
  const std::int64_t y = month > 2 ? year : year - 1;
  const std::int64_t m = month > 2 ? month : month + 12;
  const std::int64_t century = floorDivide(y, 100);
  const std::int64_t b = isGregorian(year, month, day) ? 2 - century + floorDivide(century, 4) : 0;
  return floorDivide(1461 * (y + 4716), 4) + 306001 * (m + 1) / 10000 + day + b - 1524;
}

Instant midnightOf(const CivilDate& date) {
  requireDate(date);
  return Instant(julianDayNumber(date.year, date.month, date.day),
                 -kNanosecondsPerNoon - timezoneNanoseconds(date.timezone));
}

Instant instantOf(const CivilDateTime& civil) {
  const Instant midnight = midnightOf({civil.year, civil.month, civil.day, civil.timezone});
  requireClock(civil);
  const std::int64_t second = std::llround(civil.second * static_cast<double>(kNanosecondsPerSecond));
  return midnight.plusNanoseconds((civil.hour * 60LL + civil.minute) * 60LL * kNanosecondsPerSecond + second);
}

CivilDateTime civilOf(const Instant& instant, double timezone) {
  // Half a day on, so that the whole day number changes at midnight.
  const Instant local = instant.plusNanoseconds(timezoneNanoseconds(timezone) + kNanosecondsPerNoon);
  // Meeus, Astronomical Algorithms, chapter 7, in whole numbers.
  std::int64_t a = local.julianDay();
  if (a >= kFirstGregorianDay) {
    const std::int64_t alpha = (4 * a - 7468865) / 146097;
    a += 1 + alpha - alpha / 4;
  }
  const std::int64_t b = a + 1524;
  const std::int64_t c = (20 * b - 2442) / 7305;
  const std::int64_t d = 1461 * c / 4;
  const std::int64_t e = (b - d) * 10000 / 306001;

  CivilDateTime civil;
  civil.day = static_cast<int>(b - d - 306001 * e / 10000);
  civil.month = static_cast<int>(e < 14 ? e - 1 : e - 13);
  civil.year = static_cast<int>(civil.month > 2 ? c - 4716 : c - 4715);
  const std::int64_t ns = local.nanosecondsOfDay();
  civil.hour = static_cast<int>(ns / kNanosecondsPerHour);
  civil.minute = static_cast<int>(ns / (60 * kNanosecondsPerSecond) % 60);
  civil.second =
      static_cast<double>(ns % (60 * kNanosecondsPerSecond)) / static_cast<double>(kNanosecondsPerSecond);
  civil.timezone = timezone;
  return civil;
}

}  // namespace sunlit::astronomy
