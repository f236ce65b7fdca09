// SPDX-License-Identifier: Apache-2.0
#include "braking_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace indurop::robot {

namespace {

constexpr double kStep = 0.00025;  // s
constexpr int kPlaces = 300;
constexpr double kNever = std::numeric_limits<double>::infinity();

struct Rate {
  Joints first, second, third;
};
struct Motion {
  double x = 0, v = 0, a = 0;
};
struct Span {
  double low = -kNever, high = kNever;
  [[nodiscard]] bool empty() const { return low > high; }
};

// |first * y + rest| <= most for all joints.
Span span_of(const Joints& first, const Joints& rest, const Joints& most) {
  Span span;
  for (int i = 0; i < kAxes; ++i) {
    if (std::abs(first[i]) < 1e-12) {
      if (std::abs(rest[i]) > most[i]) {
        return {1, -1};
      }
      continue;
    }
    const double one = (-most[i] - rest[i]) / first[i];
    const double other = (most[i] - rest[i]) / first[i];
    span.low = std::max(span.low, std::min(one, other));
    span.high = std::min(span.high, std::max(one, other));
  }
  return span;
}

class Search {
 public:
  explicit Search(const BrakingTask& task) : task_(task) {
    const double reach = std::min(task.length, task.speed * 0.5 + 1e-6);
    spacing_ = reach / kPlaces;
    const double e = std::max(task.speed * 0.002, 1e-5);
    for (int i = 0; i <= kPlaces; ++i) {
      const double x = spacing_ * i;
      const Joints a = task.path(x - 2 * e);
      const Joints b = task.path(x - e);
      const Joints c = task.path(x);
      const Joints d = task.path(x + e);
      const Joints f = task.path(x + 2 * e);
      rates_.push_back(
          {(a - 8 * b + 8 * d - f) / (12 * e), (b - 2 * c + d) / (e * e), (f - 2 * d + 2 * b - a) / (2 * e * e * e)});
    }
  }

  // Brakes with this part of the jerk and never harder than `hardest`, then takes it back.
  double time_with(double part, double hardest) {
    std::vector<Motion> braking{{0, task_.speed, task_.acceleration}};
    while (braking.size() < 4000 && brake(braking, part, hardest)) {
    }
    std::size_t early = 0;
    std::size_t late = braking.size();
    double best = kNever;
    while (early < late) {
      const std::size_t middle = (early + late) / 2;
      double end = 0;
      const int steps = release(braking[middle], end);
      if (steps >= 0 && end >= 0) {
        if (end <= 0.01 * task_.speed) {
          best = kStep * (static_cast<double>(middle) + steps);
        }
        early = middle + 1;
      } else {
        late = middle;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] const Rate& rate(double x) const {
    return rates_[static_cast<std::size_t>(std::clamp(x / spacing_ + 0.5, 0.0, kPlaces + 0.0))];
  }
  [[nodiscard]] Span jerks(const Motion& m) const {
    const Rate& r = rate(m.x);
    return span_of(r.first, 3 * r.second * m.v * m.a + r.third * m.v * m.v * m.v, task_.most_jerk);
  }
  [[nodiscard]] Span accelerations(const Motion& m) const {
    const Rate& r = rate(m.x);
    return span_of(r.first, r.second * m.v * m.v, task_.most_acceleration);
  }
  static Motion moved(const Motion& m, double jerk) {
    const double a = m.a + jerk * kStep;
    const double v = m.v + (m.a + a) / 2 * kStep;
    return {m.x + (m.v + v) / 2 * kStep, v, a};
  }

  bool brake(std::vector<Motion>& way, double part, double hardest) const {
    const Motion& now = way.back();
    const Span allowed = jerks(now);
    const double jerk = allowed.low < 0 ? part * allowed.low : allowed.low;
    Motion next = moved(now, jerk);
    const Span span = accelerations(next);
    const double least = std::max(span.low, -hardest);
    if (next.a < least) {
      next = moved(now, std::min((least - now.a) / kStep, allowed.high));
      if (next.a < span.low - 1e-6 * std::abs(span.low)) {
        return false;
      }
    }
    if (allowed.empty() || span.empty() || next.v <= 0) {
      return false;
    }
    way.push_back(next);
    return true;
  }

  // Steps until the acceleration is 0, and the speed there; below 0 if limits break on the way.
  int release(Motion m, double& end) const {
    for (int steps = 0; steps < 4000; ++steps) {
      const Span allowed = jerks(m);
      if (m.a >= 0) {
        end = m.v;
        return steps;
      }
      if (allowed.empty() || allowed.high <= 0) {
        return -1;
      }
      Motion next = moved(m, std::min(allowed.high, -m.a / kStep));
      const Span span = accelerations(next);
      if (next.a > span.high) {
        next = moved(m, std::max(allowed.low, (span.high - m.a) / kStep));
      }
      if (span.empty() || next.a < span.low - 1e-6 * std::abs(span.low) || next.v < -1e-9) {
        end = -1;
        return next.v < 0 ? steps : -1;
      }
      m = next;
    }
    return -1;
  }

  const BrakingTask& task_;
  double spacing_ = 0;
  std::vector<Rate> rates_;
};

}  // namespace

double least_braking_time(const BrakingTask& task) {
  Search search(task);
  double best = kNever;
  const double scale = task.speed / 0.1;
  for (const double part : {1.0, 0.8, 0.6, 0.4}) {
    for (double hardest = 100 * scale; hardest > 0.02 * scale; hardest *= 0.8) {
      best = std::min(best, search.time_with(part, hardest));
    }
  }
  return best;
}

}  // namespace indurop::robot
