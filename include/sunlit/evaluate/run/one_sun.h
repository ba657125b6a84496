/// Whether the captures of a condition were taken under one sun.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/run/records.h"

namespace sunlit::evaluate {

/// Problem::kind of a capture under another sun than that of its condition.
inline constexpr const char* kOtherSun = "other_sun";

/// A capture under another sun.
struct OtherSun {
  std::int64_t stamp_ns = 0;
  std::string fault;  ///< in words, and what may have made it
};

/// Captures of one stream, by rising stamp.
using Captures = std::vector<CaptureRecord>;

/// Whether all tell the same `utc`, for longer than a clock may wait for its first subscriber.
bool standsStill(const Captures& captures);

/// In words, where those of two runs are of different suns; else empty. Where the stamps of both are not `of
/// one clock`, suns that move are compared by their site alone.
std::string differenceOf(const Captures& a, const Captures& b, bool are_of_one_clock);

/// The captures of one condition. Its sun is that of the first: it stands still, or its civil time goes on
/// with the stamps at one rate, which nobody tells and they show. A clock that is set meanwhile jumps.
class OneSun {
 public:
  /// Of a capture whose `utc` is known. Returns the captures of which it is known by now, and was not before,
  /// that their sun is another.
  std::vector<OtherSun> add(const CaptureRecord& capture);
  /// No more will come: the same of those that waited for more.
  std::vector<OtherSun> finish();

 private:
  struct Seen {
    std::int64_t stamp_ns;
    Instant utc;
    std::string text;  // of utc
  };
  static double rateOf(const Seen& a, const Seen& b);
  static bool isOnLine(const Seen& a, const Seen& b, const Seen& c);
  static bool isNear(const Seen& a, const Seen& b);
  bool isAlone() const { return first_->stamp_ns == latest_->stamp_ns; }
  bool isBeginning() const;
  bool beganLate() const;
  std::vector<OtherSun> settleBeginning();
  std::vector<OtherSun> goOnFrom(const Seen& first, const Seen& latest);
  void takeForFast();
  std::vector<OtherSun> takeDoubtful();
  std::string faultOf(const Seen& seen) const;

  std::optional<Seen> first_, latest_;  // of those under the one sun; they give the rate
  std::vector<Seen> doubtful_;          // none of them goes on from these
  bool is_settled_ = false;             // whatever is doubtful from now on is of another sun
};

/// Where the captures of one condition see the sun from. As civil time goes on it turns no faster than the
/// sky; it jumps where its site is set meanwhile.
class OneSite {
 public:
  /// Of a capture whose `utc` is known: in words, where its sun is of another site than the first's; else
  /// empty.
  std::string faultOf(const CaptureRecord& capture);

 private:
  struct Seen {
    Instant utc;
    Eigen::Vector3d towards;  // unit
  };
  static bool jumps(const Seen& a, const Seen& b);
  static double apart_deg(const Seen& a, const Seen& b);

  std::optional<Seen> latest_;  // of the first's site
  std::optional<Seen> before_;  // of any
  bool is_elsewhere_ = false;
};

/// Those of all conditions, by their names.
class Suns {
 public:
  /// Of one whose picture an earlier run evaluated: what is added has to go on from its sun. Before any is
  /// added, by rising stamp.
  void takeUp(const std::string& stream, const CaptureRecord& capture);
  /// As OneSun::add(); nothing where `utc` is unknown. One of each stamp.
  std::vector<OtherSun> add(const std::string& stream, const CaptureRecord& capture);
  std::vector<OtherSun> finish(const std::string& stream);
  /// As far as known by now.
  bool isOther(const std::string& stream, std::int64_t stamp_ns) const {
    return others_.count({stream, stamp_ns}) > 0;
  }

 private:
  std::vector<OtherSun> kept(const std::string& stream, std::vector<OtherSun> found);
  std::map<std::string, OneSun> suns_;
  std::map<std::string, OneSite> sites_;
  std::set<std::pair<std::string, std::int64_t>> others_;  // by stream and stamp
};

}  // namespace sunlit::evaluate
