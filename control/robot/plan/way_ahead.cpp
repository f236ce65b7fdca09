// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/way_ahead.h"

#include <algorithm>
#include <array>

#include "control/robot/path/followed_path.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kTimes = 192;       // from which the places of a part are chosen
constexpr std::size_t kRoundedMost = 8;   // places of a blend
constexpr double kTolerated = 1e-3;       // m, or this part of the way:
constexpr double kPartTolerated = 0.02;   // by which the line between two places may miss the way
constexpr double kSpeedTolerated = 0.05;  // part of the greatest speed, likewise
constexpr double kEnough = 0.05;          // of what is tolerated: more places show nothing

// The tool at equal intervals of time, and the few places that describe its way best: again and again the place that
// is farthest from the line between its neighbours is added.
class Thinning {
 public:
  template <class Tip>
  Thinning(double seconds, bool from_rest, bool to_rest, const Tip& tip) noexcept {
    for (std::size_t i = 0; i <= kTimes; ++i) {
      at_[i].place = tip(seconds * static_cast<double>(i) / kTimes);
      at_[i].gone = i == 0 ? 0 : at_[i - 1].gone + (at_[i].place - at_[i - 1].place).norm();
    }
    for (std::size_t i = 0; i <= kTimes && seconds > 0; ++i) {
      const std::size_t before = i > 0 ? i - 1 : 0;
      const std::size_t behind = std::min(i + 1, kTimes);
      const bool rests = (i == 0 && from_rest) || (i == kTimes && to_rest);
      at_[i].speed =
          rests ? 0 : (at_[behind].gone - at_[before].gone) * kTimes / (seconds * static_cast<double>(behind - before));
      fastest_ = std::max(fastest_, at_[i].speed);
    }
  }

  // Adds at most `most` places, at least 2; the first one only if the way has none.
  void add_to(ToolWay& way, std::size_t most) noexcept {
    std::array<std::size_t, kWayPlaces> chosen{0, kTimes};
    std::array<Worst, kWayPlaces> worst{look(0, kTimes)};  // after each chosen one
    std::size_t count = 2;
    for (; count < most; ++count) {
      auto* const end = worst.begin() + static_cast<std::ptrdiff_t>(count) - 1;
      auto* const split = std::max_element(worst.begin(), end, [](auto& a, auto& b) { return a.misses < b.misses; });
      if (split->misses < kEnough) {
        break;
      }
      const auto k = static_cast<std::size_t>(split - worst.begin());
      const std::size_t middle = split->at;
      std::copy_backward(chosen.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                         chosen.begin() + static_cast<std::ptrdiff_t>(count),
                         chosen.begin() + static_cast<std::ptrdiff_t>(count) + 1);
      std::copy_backward(split + 1, end, end + 1);
      chosen[k + 1] = middle;
      worst[k] = look(chosen[k], middle);
      worst[k + 1] = look(middle, chosen[k + 2]);
    }
    for (std::size_t k = way.count == 0 ? 0 : 1; k < count; ++k) {
      put(at_[chosen[k]], way);
    }
  }

 private:
  struct At {
    Vec3 place = Vec3::Zero();
    double gone = 0;   // m, on the way
    double speed = 0;  // m/s
  };
  struct Worst {
    std::size_t at = 0;
    double misses = 0;  // 1: as far as is tolerated
  };

  static void put(const At& at, ToolWay& way) noexcept {
    const std::size_t i = way.count++;
    for (std::size_t k = 0; k < 3; ++k) {
      way.place[i][k] = static_cast<float>(1000 * at.place[static_cast<int>(k)]);
    }
    way.speed[i] = static_cast<float>(1000 * at.speed);
  }

  [[nodiscard]] Worst look(std::size_t from, std::size_t to) const noexcept {
    const At& a = at_[from];
    const At& b = at_[to];
    const double far = std::max(kTolerated, kPartTolerated * at_[kTimes].gone);
    const double fast = std::max(kTolerated, kSpeedTolerated * fastest_);
    Worst worst;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double part = b.gone > a.gone ? (at_[i].gone - a.gone) / (b.gone - a.gone) : 0;
      const double missed = (a.place + part * (b.place - a.place) - at_[i].place).norm() / far;
      const double slower = std::abs(a.speed + part * (b.speed - a.speed) - at_[i].speed) / fast;
      if (const double misses = std::max(missed, slower); misses > worst.misses) {
        worst = {i, misses};
      }
    }
    return worst;
  }

  std::array<At, kTimes + 1> at_;
  double fastest_ = 0;
};

Vec3 tip_at(const Places& places, const Segment& s, double place) noexcept {
  if (s.move != Move::Joint && s.joint_path == nullptr) {
    return s.calm_at(s.timed ? s.timing.at(place).place : place).position;
  }
  Joints q = s.from;
  static_cast<void>(places.on(s, place, s.from, q));
  return places.arm().forward(q).position;
}

// As FollowedPath::begin_blend() decides where `before` begins.
bool has_time(const LineState& start, const Segment& before, const Blend& blend, double speed) noexcept {
  const double left = before.length - blend.zone - start.position;
  return speed > FollowedPath::kStill && left > 0 &&
         (start.velocity <= 0 || ramp(start, std::min(speed, start.velocity), before.limits).distance <= left);
}

}  // namespace

// The rest of a motion from `start_`, where it has `speed_`; `exit`: its speed at the place `to`.
void WayAhead::add_part(const Segment& segment, double to, double exit, bool rests, std::size_t most,
                        ToolWay& way) noexcept {
  const Profile profile = Profile::to_position({start_, speed_, 0}, to, exit, segment.limits);
  if (profile.duration() <= 0 && way.count > 0) {
    return;  // a short motion that is all blends
  }
  Thinning(profile.duration(), speed_ <= 0, rests, [&](double time) {
    return tip_at(places_, segment, std::clamp(profile.at(time).position, 0.0, to));
  }).add_to(way, most);
}

void WayAhead::sample(const Segment& before, const Blend& blend, const Segment& segment, ToolWay* cut,
                      ToolWay& way) noexcept {
  way.count = 0;
  const double fastest = blend.zone > 0 ? blend_speed(blend, segment) : 0;
  const bool blended = blend.zone > 0 && has_time({start_, speed_, 0}, before, blend, fastest);
  if (blend.zone > 0) {
    cut->count = 0;
  }
  if (blended) {
    cut->count = static_cast<std::uint32_t>(rounded_);
    std::copy_n(last_.place.begin(), rounded_, cut->place.begin());
    std::copy_n(last_.speed.begin(), rounded_, cut->speed.begin());
    const double end = before.length - blend.zone;
    const Profile to = Profile::to_position({start_, speed_, 0}, end, fastest, before.limits);
    add_part(before, end, fastest, false, kWayPlaces - rounded_, *cut);
    const double speed = std::clamp(to.end().velocity, FollowedPath::kStill, fastest);
    const Profile over = Profile::to_position({0, speed, 0}, blend.length(), fastest, blend.limits);
    Joints q = before.to;
    Thinning(over.duration(), false, false, [&](double time) {
      const double place = std::clamp(over.at(time).position, 0.0, blend.length());
      static_cast<void>(places_.on(before, blend, segment, place, q, q));
      return places_.arm().forward(q).position;
    }).add_to(way, kRoundedMost);
    start_ = blend.zone;
    speed_ = over.end().velocity;
  } else {
    start_ = speed_ = 0;
  }
  rounded_ = way.count;
  Segment timed = segment;
  if (!blended && segment.together) {
    timed.take_joint_timing({segment.from, Joints::Zero(), Joints::Zero()}, joints_, 1);
  } else if (!blended && segment.timing.known()) {
    timed.take_timing();
  }
  if (timed.timed) {
    Thinning(timed.length, true, true, [&](double time) {
      return tip_at(places_, timed, time);
    }).add_to(way, kWayPlaces);
  } else {
    add_part(timed, timed.length, 0, true, kWayPlaces - rounded_ + (rounded_ > 0 ? 1 : 0), way);
  }
  last_ = way;
}

}  // namespace indurop::robot
