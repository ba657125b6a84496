#include "sunlit/evaluate/run/one_sun.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

/// s of sun time: the sun moves by less than 0.005°, a hundredth of its width. So far may a capture be off.
constexpr double kSame_s = 1.0;
constexpr double kRounding_s = 2e-3;  // of two times: civil time is sent in ms
/// s of ROS time: under a clock that waits for its first subscriber the sun stands for so long at most.
constexpr double kLateStart_s = 1.0;

/// deg: what rounding makes of a sun that stands still, 1 km on the ground; and of one that moves, what its
/// refraction may change besides.
constexpr double kSameDirection_deg = 0.02, kRefracts_deg = 0.7;
/// Of the sky's turn: while refraction changes, the sun moves by a fifth more or less.
constexpr double kFastest = 1.25;
constexpr double kTurn_deg_s = 360.0 / 86164.0;

Eigen::Vector3d sunOf(const CaptureRecord& capture) {
  const double azimuth = capture.sun_azimuth_deg * kRadPerDeg,
               elevation = capture.sun_elevation_deg * kRadPerDeg;
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
          std::sin(elevation)};
}

double secondsFrom(std::int64_t a_ns, std::int64_t b_ns) {
  return 1e-9 * static_cast<double>(b_ns - a_ns);
}

std::string differenceWithin(const Captures& captures, bool has_clock) {
  OneSite site;
  OneSun sun;
  std::vector<OtherSun> others;
  for (const CaptureRecord& capture : captures) {
    if (!capture.utc) continue;
    if (const std::string fault = site.faultOf(capture); !fault.empty()) return fault;
    if (has_clock) others = sun.add(capture);
    if (!others.empty()) return others.front().fault;
  }
  others = sun.finish();
  return others.empty() ? "" : others.front().fault;
}

}  // namespace

bool standsStill(const Captures& captures) {
  if (captures.empty() || !captures.front().utc) return false;
  const auto isOfFirst = [&](const CaptureRecord& capture) { return capture.utc == captures.front().utc; };
  return secondsFrom(captures.front().stamp_ns, captures.back().stamp_ns) > kLateStart_s &&
         std::all_of(captures.begin(), captures.end(), isOfFirst);
}

std::string differenceOf(const Captures& a, const Captures& b, bool are_of_one_clock) {
  if (a.empty() || b.empty()) return "";
  Captures all = a;
  all.insert(all.end(), b.begin(), b.end());
  if (are_of_one_clock) {
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& l, const auto& r) { return l.stamp_ns < r.stamp_ns; });
    return differenceWithin(all, true);
  }
  // Nobody can tell when the one was after the other, which does not matter to suns that stand still.
  const std::int64_t later_ns = a.back().stamp_ns - b.front().stamp_ns + 1;
  std::for_each(all.begin() + static_cast<std::ptrdiff_t>(a.size()), all.end(),
                [=](CaptureRecord& capture) { capture.stamp_ns += later_ns; });
  return differenceWithin(all, standsStill(a) && standsStill(b));
}

// s of sun time a second of ROS time; 0 for one and the same.
double OneSun::rateOf(const Seen& a, const Seen& b) {
  return a.stamp_ns == b.stamp_ns ? 0.0 : b.utc.secondsSince(a.utc) / secondsFrom(a.stamp_ns, b.stamp_ns);
}

// Whether c has the time to which the clock goes on from b, at its rate from a to b.
bool OneSun::isOnLine(const Seen& a, const Seen& b, const Seen& c) {
  const double base_s = std::abs(secondsFrom(a.stamp_ns, b.stamp_ns));
  const double gap_s = secondsFrom(b.stamp_ns, c.stamp_ns);
  const double passes_s = rateOf(a, b) * gap_s;
  const double uncertain_s = base_s > 0.0 ? kRounding_s * std::abs(gap_s) / base_s : 0.0;
  return std::abs(c.utc.secondsSince(b.utc) - passes_s) <= kSame_s + uncertain_s;
}

bool OneSun::isNear(const Seen& a, const Seen& b) {
  return std::abs(b.utc.secondsSince(a.utc)) <= kSame_s;
}

std::vector<OtherSun> OneSun::add(const CaptureRecord& capture) {
  const Seen seen{capture.stamp_ns, *capture.utc, capture.utc_text};
  if (!first_) first_ = latest_ = seen;
  if (isOnLine(*first_, *latest_, seen)) {
    if (seen.stamp_ns > latest_->stamp_ns) latest_ = seen;
    return takeDoubtful();
  }
  doubtful_.push_back(seen);
  return isBeginning() ? settleBeginning() : takeDoubtful();
}

// The sun has not been seen to move, nor to stand for long.
bool OneSun::isBeginning() const {
  return !is_settled_ && first_->utc == latest_->utc &&
         secondsFrom(first_->stamp_ns, latest_->stamp_ns) <= kLateStart_s;
}

// A sun that moves fast is doubtful at first, as one that was set is. Which of them it is, those that follow
// tell.
std::vector<OtherSun> OneSun::settleBeginning() {
  const std::vector<Seen>& d = doubtful_;
  if (d.size() == 1) return {};
  if (d.size() == 2) {
    if (isAlone() && isOnLine(*first_, d[0], d[1])) return goOnFrom(*first_, d[1]);
    if (!isNear(d[0], d[1])) return {};
  } else if (!isOnLine(d[0], d[1], d[2])) {
    takeForFast();
  } else if (beganLate()) {
    return goOnFrom(d[0], d[2]);
  }
  is_settled_ = true;
  return takeDoubtful();
}

// The doubtful ones are of the one sun.
std::vector<OtherSun> OneSun::goOnFrom(const Seen& first, const Seen& latest) {
  std::tie(first_, latest_) = std::make_pair(first, latest);
  doubtful_.clear();
  return {};
}

// The clock, that of the doubtful ones, stood at first and then began to run: without a jump.
bool OneSun::beganLate() const {
  const Seen& next = doubtful_.front();
  const double ran_s = next.utc.secondsSince(latest_->utc) / rateOf(next, doubtful_.back());
  return ran_s >= 0.0 && ran_s <= secondsFrom(latest_->stamp_ns, next.stamp_ns);
}

// The next that follow the first are on no line: the sun moved to the first of them, and then was set.
void OneSun::takeForFast() {
  if (!isAlone()) return;
  latest_ = doubtful_.front();
  doubtful_.erase(doubtful_.begin());
}

// Two captures alone that differ are of a sun that moves fast, or was set: nobody can tell.
std::vector<OtherSun> OneSun::finish() {
  if (doubtful_.size() == 1 && isAlone()) doubtful_.clear();
  if (doubtful_.size() > 1) takeForFast();
  return takeDoubtful();
}

std::vector<OtherSun> OneSun::takeDoubtful() {
  std::vector<OtherSun> others;
  for (const Seen& seen : doubtful_) others.push_back({seen.stamp_ns, faultOf(seen)});
  doubtful_.clear();
  return others;
}

std::string OneSun::faultOf(const Seen& seen) const {
  const double passed_s = rateOf(*first_, *latest_) * secondsFrom(first_->stamp_ns, seen.stamp_ns);
  const std::string passed = std::abs(passed_s) < kSame_s ? "" : " + " + textOf(std::round(passed_s)) + " s";
  return "its sky is of " + seen.text + ", not of " + first_->text + passed +
         " as by the first capture: was the sun set meanwhile (set_date_time)?";
}

bool OneSite::jumps(const Seen& a, const Seen& b) {
  const double passed_s = std::abs(b.utc.secondsSince(a.utc));
  const double may_deg = passed_s <= kSame_s ? kSameDirection_deg + kTurn_deg_s * passed_s
                                             : kRefracts_deg + kFastest * kTurn_deg_s * passed_s;
  return apart_deg(a, b) > may_deg;
}

double OneSite::apart_deg(const Seen& a, const Seen& b) {
  return std::atan2(a.towards.cross(b.towards).norm(), a.towards.dot(b.towards)) / kRadPerDeg;
}

std::string OneSite::faultOf(const CaptureRecord& capture) {
  const Seen seen{*capture.utc, sunOf(capture)};
  if (!seen.towards.allFinite()) return "";
  if (!latest_) latest_ = before_ = seen;
  // And back, where it is back indeed.
  if (jumps(*before_, seen)) is_elsewhere_ = !is_elsewhere_ || jumps(*latest_, seen);
  before_ = seen;
  if (!is_elsewhere_) {
    latest_ = seen;
    return "";
  }
  return "its sun stands " + textOf(apart_deg(*latest_, seen), 3) +
         " deg from that of the captures before, farther than it turns meanwhile: was the site set "
         "(set_site)?";
}

// Those that are of another sun were told of by the run that evaluated them.
void Suns::takeUp(const std::string& stream, const CaptureRecord& capture) {
  if (!capture.utc || !sites_[stream].faultOf(capture).empty()) return;
  suns_[stream].add(capture);
}

std::vector<OtherSun> Suns::add(const std::string& stream, const CaptureRecord& capture) {
  if (!capture.utc) return {};
  const std::string fault = sites_[stream].faultOf(capture);
  if (!fault.empty()) return kept(stream, {{capture.stamp_ns, fault}});
  return kept(stream, suns_[stream].add(capture));
}

std::vector<OtherSun> Suns::finish(const std::string& stream) {
  return kept(stream, suns_[stream].finish());
}

std::vector<OtherSun> Suns::kept(const std::string& stream, std::vector<OtherSun> found) {
  for (const OtherSun& other : found) others_.emplace(stream, other.stamp_ns);
  return found;
}

}  // namespace sunlit::evaluate
