// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/brake.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

namespace {

constexpr double kKept = 0.97;         // of the jerk when planning ahead: covers the error of the polynomials
constexpr double kWithin = 1 - 2e-5;   // of the limits: covers rounding
constexpr double kExactly = 1 + 5e-5;  // the same on a path that may use all of them: half of what the last gate allows
constexpr int kParts = 8;              // of the time in which braking is released
constexpr double kTooLate = -1;
constexpr double kMostBeyond = 1000;  // of the limits that cannot be kept
constexpr int kBeyondHalves = 24;
constexpr double kDropped = 0.3;  // of a period's jerk: the speed that is left for the last one

}  // namespace

void PathBrake::begin(double hardness) noexcept {
  hardness_ = hardness;
  length_ = gone_ = changed_ = 0;
}

// A motion may use all of the limits where its path is known exactly. If less than that counted, it would be too fast
// for its own path, and get faster to stay within what counts.
void PathBrake::set_path(const PathAhead& path) noexcept {
  exact_ = path.has_shape() ? &path : nullptr;
  const double part = exact_ != nullptr ? kExactly : kWithin;
  acceleration_ = part * hardness_ * most_.acceleration;
  jerk_ = part * hardness_ * hardness_ * most_.jerk;
}

Reach PathBrake::fit(const PathAhead& path, Joints& near, double from, double length) noexcept {
  std::array<Joints, 5> f;
  f[0] = near;
  for (std::size_t i = 1; i < 5; ++i) {
    const Reach reach = path.joints_on_path(from + length * static_cast<double>(i) / 4, near, f[i]);
    if (reach != Reach::Ok) {
      return reach;
    }
    near = f[i];
  }
  const Joints d1 = f[1] - f[0];
  const Joints d2 = f[2] - 2 * f[1] + f[0];
  const Joints d3 = f[3] - 3 * f[2] + 3 * f[1] - f[0];
  const Joints d4 = f[4] - 4 * f[3] + 6 * f[2] - 4 * f[1] + f[0];
  shape_[pieces_] = {f[0], d1 - d2 / 2 + d3 / 3 - d4 / 4, d2 / 2 - d3 / 2 + d4 * (11.0 / 24), d3 / 6 - d4 / 4, d4 / 24};
  return Reach::Ok;
}

Reach PathBrake::look_ahead(const PathAhead& path, const Joints& here, double distance) noexcept {
  timed_ = path.is_timed();
  const auto time = [&](int i) { return path.timed_ahead(distance * i / kTimes); };
  const double way = timed_ ? time(kTimes).place : distance;
  pieces_ = 0;
  bounds_[0] = 0;
  Joints near = here;
  while (bounds_[pieces_] < way) {
    const double from = bounds_[pieces_];
    const double end = pieces_ == kMostPieces - 1 ? way : std::min(way, path.smooth_until(from));
    if (const Reach reach = fit(path, near, from, end - from); reach != Reach::Ok) {
      return reach;
    }
    bounds_[++pieces_] = end;
  }
  for (int i = 0; i <= kTimes && timed_; ++i) {
    times_[static_cast<std::size_t>(i)] = time(i);
  }
  length_ = distance;
  gone_ = 0;
  return Reach::Ok;
}

// Interpolates between two instants by a polynomial of the fifth degree.
Timed PathBrake::timed(double place) const noexcept {
  if (!timed_) {
    return {place, 1, 0, 0};
  }
  const double unit = kTimes / length_;
  const double x = std::clamp(place * unit, 0.0, double{kTimes});
  const auto i = static_cast<std::size_t>(std::min(x, kTimes - 1.0));
  const Timed& from = times_[i];
  const Timed& to = times_[i + 1];
  const double t = x - static_cast<double>(i);
  const double v = from.speed / unit;
  const double a = from.acceleration / (unit * unit);
  const double s = to.place - from.place - v - a / 2;
  const double w = to.speed / unit - v - a;
  const double b = to.acceleration / (unit * unit) - a;
  const double c3 = 10 * s - 4 * w + b / 2;
  const double c4 = -15 * s + 7 * w - b;
  const double c5 = 6 * s - 3 * w + b / 2;
  return {from.place + t * (v + t * (a / 2 + t * (c3 + t * (c4 + t * c5)))),
          unit * (v + t * (a + t * (3 * c3 + t * (4 * c4 + 5 * t * c5)))),
          unit * unit * (a + t * (6 * c3 + t * (12 * c4 + 20 * t * c5))),
          unit * unit * unit * (6 * c3 + t * (24 * c4 + 60 * t * c5))};
}

// The polynomial for a place on the path; the place is converted to quarters of its part, `unit` is their number per
// unit of the path.
const PathBrake::Polynomial& PathBrake::polynomial(double& place, double& unit) const noexcept {
  std::size_t i = 0;
  while (i + 1 < pieces_ && place > bounds_[i + 1]) {
    ++i;
  }
  unit = 4 / (bounds_[i + 1] - bounds_[i]);
  place = (std::min(place, bounds_[i + 1]) - bounds_[i]) * unit;
  return shape_[i];
}

PathBrake::Rates PathBrake::rates(double place) const noexcept {
  if (exact_ != nullptr) {
    const PathAhead::Shape shape = exact_->shape_ahead(place - gone_);
    return {shape.first, shape.second, shape.third};
  }
  const Timed now = timed(place);
  double t = now.place;
  double unit = 0;
  const Polynomial& c = polynomial(t, unit);
  const Joints first = unit * (c[1] + t * (2 * c[2] + t * (3 * c[3] + 4 * t * c[4])));
  const Joints second = unit * unit * (2 * c[2] + t * (6 * c[3] + 12 * t * c[4]));
  const Joints third = unit * unit * unit * (6 * c[3] + 24 * t * c[4]);
  if (!timed_) {
    return {first, second, third};
  }
  const double v = now.speed;
  return {v * first, v * v * second + now.acceleration * first,
          v * v * v * third + 3 * v * now.acceleration * second + now.jerk * first};
}

PathBrake::Span PathBrake::span_of(const Joints& first, const Joints& rest, const Joints& most) noexcept {
  Span span{-HUGE_VAL, HUGE_VAL};
  for (int i = 0; i < kAxes; ++i) {
    const double size = std::abs(first[i]);
    if (size < 1e-12) {
      if (std::abs(rest[i]) > most[i]) {
        return {1, -1};
      }
      continue;
    }
    const double middle = (first[i] < 0 ? rest[i] : -rest[i]) / size;
    const double reach = most[i] / size;
    span.low = std::max(span.low, middle - reach);
    span.high = std::min(span.high, middle + reach);
  }
  return span;
}

// The limits apply to the differences between set points, so these are checked: exact for any period.
PathBrake::Span PathBrake::distances(const PathHistory& past, const Joints& there, double distance,
                                     double period) const noexcept {
  const auto& q = past.joints;
  const Joints first = rates(gone_ + distance).first;
  const double square = period * period;
  const auto within = [&](double part) {
    const Span spans[] = {span_of(first, there - q[0], part * period * most_.velocity),
                          span_of(first, there - 2 * q[0] + q[1], part * square * acceleration_),
                          span_of(first, there - 3 * q[0] + 3 * q[1] - q[2], part * square * period * jerk_)};
    Span all{-HUGE_VAL, HUGE_VAL};
    for (const Span& span : spans) {
      all = {std::max(all.low, distance + span.low), std::min(all.high, distance + span.high)};
    }
    return all;
  };
  const auto possible = [&](double part) {
    const Span span = within(part);
    return span.low <= span.high;
  };
  return possible(1) ? within(1) : within(bisect({kMostBeyond, 1}, kBeyondHalves, possible).holds);
}

PathBrake::Motion PathBrake::after(double distance, const PathHistory& past, double period) const noexcept {
  return {gone_ + distance, distance / period, (distance - past.moved[0]) / (period * period)};
}

PathBrake::Span PathBrake::jerks(const Rates& r, const Motion& m) const noexcept {
  return span_of(r.first, 3 * m.speed * m.acceleration * r.second + m.speed * m.speed * m.speed * r.third,
                 (exact_ != nullptr ? 1 : kKept) * jerk_);
}

// Steps through as many periods as it takes, several at a time if there are many; computed as differences between
// periods add up, so that the last period is exact.
double PathBrake::left_over(Motion m, double period) const noexcept {
  Span jerk = jerks(rates(m.place), m);
  const double stride = std::max(1.0, std::ceil(-m.acceleration / (jerk.high * period * kParts)));
  const double taken = stride * period;
  for (int i = 0; i < 3 * kParts && m.acceleration < 0; ++i) {
    if (jerk.low > jerk.high || jerk.high <= 0) {
      return kTooLate;
    }
    const auto moved = [&](double most) {
      const double step = most * period;
      const double steps = std::min(stride, std::floor(-m.acceleration / step));
      const double v = m.speed + period * steps * (m.acceleration + step * (steps + 1) / 2);
      return Motion{m.place + taken * (m.speed + v) / 2, v, steps < stride ? 0 : m.acceleration + steps * step};
    };
    Motion next = moved(jerk.high);
    const Rates there = rates(next.place);
    const Span behind = jerks(there, next);
    next = moved(std::max(std::min(jerk.high, behind.high), 1e-3 * jerk.high));
    if (next.speed < 0) {
      return next.speed;
    }
    const Span span = span_of(there.first, next.speed * next.speed * there.second, acceleration_);
    const double slack = 1e-3 * (span.high - span.low);
    next.acceleration = std::min(next.acceleration, span.high);
    if (span.low > span.high || next.acceleration < span.low - slack ||
        next.acceleration < m.acceleration + jerk.low * taken) {
      return kTooLate;
    }
    m = next;
    jerk = behind;
  }
  // A motion that slow may stop in the next period.
  return m.speed - kDropped * jerk.high * period * period;
}

double PathBrake::choose(const Span& span, const PathHistory& past, double period) const noexcept {
  if (span.low > span.high) {
    return (span.low + span.high) / 2;
  }
  const auto in_time = [&](double distance) { return left_over(after(distance, past, period), period) >= 0; };
  if (in_time(span.low)) {
    return span.low;
  }
  // The last few periods are those needed for standing still at their end.
  const double change = (span.high - span.low) / (period * period);
  const bool last = -after(span.high, past, period).acceleration < 2 * change;
  return bisect({span.high, span.low}, last ? 20 : 6, in_time).holds;
}

// The approximate distance to rest, as if the path continued as it did so far.
double PathBrake::far(const PathHistory& past, double period) const noexcept {
  const double step = past.moved[0];
  const Joints first = (past.joints[0] - past.joints[1]).cwiseAbs() / std::max(step, 1e-12);
  LineLimits limits{1, HUGE_VAL, HUGE_VAL};
  for (int i = 0; i < kAxes; ++i) {
    limits.acceleration = std::min(limits.acceleration, acceleration_[i] / std::max(first[i], 1e-9));
    limits.jerk = std::min(limits.jerk, jerk_[i] / std::max(first[i], 1e-9));
  }
  const double acceleration = (step - past.moved[1]) / (period * period);
  return std::max(ramp({0, step / period, acceleration}, 0, limits).distance, 2 * step);
}

Reach PathBrake::keep_in_sight(const PathAhead& path, const PathHistory& past, double period) noexcept {
  const double need = std::min(1.2 * far(past, period), path.left());
  const bool seen = gone_ + need <= 1.5 * length_ && need >= 0.5 * length_ && gone_ <= 0.3 * length_;
  return seen ? Reach::Ok : look_ahead(path, past.joints[0], need);
}

// Returns whether the axes may stand still from this set point on.
bool PathBrake::can_stand(const PathHistory& past, double period) const noexcept {
  const auto& q = past.joints;
  const Joints last = q[0] - q[1];
  const Joints jerk = (last - (q[1] - q[2]) + last).cwiseAbs().cwiseMax(last.cwiseAbs());
  const double square = period * period;
  return (last.cwiseAbs().array() <= square * acceleration_.array()).all() &&
         (jerk.array() <= square * period * jerk_.array()).all();
}

PathBrake::Span PathBrake::inside(const Span& span, double part) noexcept {
  const double inset = part * std::max(0.0, span.high - span.low);
  return {span.low + inset, span.high - inset};
}

Joints PathBrake::joints_at(double place) const noexcept {
  if (exact_ != nullptr) {
    return exact_->shape_ahead(place - gone_).value;
  }
  double t = timed(place).place;
  double unit = 0;
  const Polynomial& c = polynomial(t, unit);
  return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
}

Reach PathBrake::next(const PathAhead& path, const PathHistory& past, double period, double& distance,
                      Joints& q) noexcept {
  constexpr int kTries = 8;
  constexpr double kInset = 1e-3;  // of the possible span: the polynomials are not that exact
  distance = 0;
  q = past.joints[0];
  set_path(path);
  if (can_stand(past, period) || path.left() <= 0) {
    return Reach::Ok;
  }
  if (exact_ == nullptr) {
    if (const Reach reach = keep_in_sight(path, past, period); reach != Reach::Ok) {
      return reach;
    }
  }
  // First uses the polynomials, which needs no inverse kinematics. Where they are not exact enough, the check is
  // repeated from the resulting place.
  const double as_before = std::max(0.0, 2 * past.moved[0] - past.moved[1] + changed_);
  Span guessed = distances(past, q + joints_at(gone_ + as_before) - joints_at(gone_), as_before, period);
  double wanted = choose(inside(guessed, exact_ != nullptr ? 0 : kInset), past, period);
  for (int tries = 0; tries < kTries; ++tries) {
    distance = std::max(0.0, wanted);
    q = past.joints[0];
    if (const Reach reach = path.joints_ahead(distance, past.joints[0], q); reach != Reach::Ok) {
      return reach;
    }
    const Span span = distances(past, q, distance, period);
    const double width = span.high - span.low;
    const bool misled =
        std::max(std::abs(span.low - guessed.low), std::abs(span.high - guessed.high)) > 5 * kInset * width;
    wanted = misled ? choose(span, past, period) : std::clamp(distance, std::min(span.low, span.high), span.high);
    guessed = span;
    if (std::abs(wanted - distance) <= 1e-6 * width) {
      break;
    }
  }
  changed_ = distance - 2 * past.moved[0] + past.moved[1];
  gone_ += distance;
  return Reach::Ok;
}

}  // namespace indurop::robot
