// SPDX-License-Identifier: Apache-2.0
#include "topp_reference.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace indurop::robot {

namespace {

constexpr int kPlaces = 4000;

struct Span {
  double low, high;
};

class Plane {
 public:
  explicit Plane(const TimingTask& task) : task_(task), step_(task.length / kPlaces), most_(kPlaces + 1, 0.0) {
    std::vector<Joints> q(kPlaces + 1);
    for (int i = 0; i <= kPlaces; ++i) {
      q[static_cast<std::size_t>(i)] = task.path(step_ * i);
    }
    for (int i = 0; i <= kPlaces; ++i) {
      const auto k = static_cast<std::size_t>(std::clamp(i, 1, kPlaces - 1));
      first_.emplace_back((q[k + 1] - q[k - 1]) / (2 * step_));
      second_.emplace_back((q[k + 1] - 2 * q[k] + q[k - 1]) / (step_ * step_));
    }
  }

  double time() {
    for (int i = kPlaces - 1; i >= 0; --i) {
      most_[static_cast<std::size_t>(i)] = controllable(static_cast<std::size_t>(i));
    }
    double now = 0;
    double sum = 0;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const double next = std::max(0.0, std::min(most_[i + 1], now + 2 * step_ * accelerations(i, now).high));
      sum += 2 * step_ / (std::sqrt(now) + std::sqrt(next));
      now = next;
    }
    return sum;
  }

 private:
  // What the joints leave of the acceleration of x if the square of its speed is this.
  [[nodiscard]] Span accelerations(std::size_t i, double square) const {
    Span span{-task_.hardest, task_.hardest};
    for (int a = 0; a < kAxes; ++a) {
      const double rate = first_[i][a];
      const double bent = second_[i][a] * square;
      const double most = task_.most_acceleration[a];
      if (std::abs(rate) < 1e-9) {
        if (std::abs(bent) > most) {
          return {1, -1};
        }
        continue;
      }
      const double one = (most - bent) / rate;
      const double other = (-most - bent) / rate;
      span = {std::max(span.low, std::min(one, other)), std::min(span.high, std::max(one, other))};
    }
    return span;
  }
  [[nodiscard]] bool leads_on(std::size_t i, double square) const {
    const Span span = accelerations(i, square);
    const double high = std::min(span.high, (most_[i + 1] - square) / (2 * step_));
    const double low = std::max(span.low, -square / (2 * step_));
    return low <= high;
  }
  // The greatest square of the speed here from which the next place can be passed too.
  [[nodiscard]] double controllable(std::size_t i) const {
    double beyond = task_.fastest;
    for (int a = 0; a < kAxes; ++a) {
      beyond = std::min(beyond, task_.most_speed[a] / std::max(std::abs(first_[i][a]), 1e-9));
    }
    beyond *= beyond;
    if (leads_on(i, beyond)) {
      return beyond;
    }
    double fits = 0;
    for (int tries = 0; tries < 50; ++tries) {
      const double middle = (fits + beyond) / 2;
      double& bound = leads_on(i, middle) ? fits : beyond;
      bound = middle;
    }
    return fits;
  }

  const TimingTask& task_;
  double step_;
  std::vector<double> most_;
  std::vector<Joints> first_, second_;
};

}  // namespace

double least_time(const TimingTask& task) {
  return Plane(task).time();
}

}  // namespace indurop::robot
