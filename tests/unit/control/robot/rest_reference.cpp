// SPDX-License-Identifier: Apache-2.0
#include "rest_reference.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

struct State {
  double x = 0, v = 0, a = 0;
  void go(double time, double jerk) {
    x += time * (v + time * (a / 2 + time * jerk / 6));
    v += time * (a + time * jerk / 2);
    a += time * jerk;
  }
};

struct Stop {
  double time = 0;
  State end;
};

// The shortest way to rest: down to acceleration -b and back, in the direction in which it moves on when its
// acceleration is taken back. v + a^2/2j = b^2/j, with the deepest b that leaves a constant part of 0 or more.
Stop stop(State s, const RestTask& task) {
  const double jerk = task.most_jerk;
  const double sign = s.v + std::abs(s.a) * s.a / (2 * jerk) < 0 ? -1 : 1;
  const double b = std::min(std::sqrt(std::max(0.0, jerk * sign * s.v + s.a * s.a / 2)), task.most_acceleration);
  Stop result;
  const auto go = [&](double time, double with) {
    s.go(time, sign * with);
    result.time += time;
  };
  go(std::max(0.0, (sign * s.a + b) / jerk), -jerk);
  go(b > 0 ? std::max(0.0, (sign * s.v - b * b / (2 * jerk)) / b) : 0, 0);
  go(b / jerk, jerk);
  result.end = s;
  return result;
}

// Whether acceleration `a` at the end of a step leaves all limits to be kept behind it.
bool allowed(State s, double a, double step, const RestTask& task) {
  s.go(step, (a - s.a) / step);
  const double top = s.v + (s.a > 0 ? s.a * s.a / (2 * task.most_jerk) : 0);
  return top <= task.most_speed * (1 + 1e-9) && stop(s, task).end.x <= task.way;
}

double forward(RestTask task, int steps) {
  State s{0, task.speed, task.acceleration};
  const double step = least_time_from_rest({std::abs(task.way) + std::abs(task.speed), 0, 0, task.most_speed,
                                            task.most_acceleration, task.most_jerk}) /
                      steps;
  double time = 0;
  for (int i = 0; i < 100 * steps; ++i) {
    double low = std::max(s.a - task.most_jerk * step, -task.most_acceleration);
    double high = std::min(s.a + task.most_jerk * step, task.most_acceleration);
    const bool exact = std::abs(stop(s, task).end.x - task.way) < 1e-9 * (1 + std::abs(task.way));
    if (exact || !allowed(s, low, step, task)) {
      break;  // what is left is braking
    }
    if (allowed(s, high, step, task)) {
      low = high;
    }
    for (int k = 0; k < 30 && high > low; ++k) {
      const double middle = (low + high) / 2;
      double& bound = allowed(s, middle, step, task) ? low : high;
      bound = middle;
    }
    s.go(step, (low - s.a) / step);
    time += step;
  }
  return time + stop(s, task).time;
}

}  // namespace

double least_time_from_rest(const RestTask& task) {
  const double way = std::abs(task.way);
  const double a = task.most_acceleration;
  const double j = task.most_jerk;
  const auto ramp = [&](double v) { return v >= a * a / j ? v / a + a / j : 2 * std::sqrt(v / j); };
  if (way >= task.most_speed * ramp(task.most_speed)) {
    return way / task.most_speed + ramp(task.most_speed);
  }
  if (way >= 2 * a * a * a / (j * j)) {
    return 2 * ramp((std::sqrt(a * a * a * a / (j * j) + 4 * a * way) - a * a / j) / 2);
  }
  return 4 * std::cbrt(way / (2 * j));
}

double least_time_to_rest(const RestTask& task, int steps) {
  // A motion that would end behind its target goes the other way; so does its mirror image.
  const RestTask mirrored{-task.way,     -task.speed, -task.acceleration, task.most_speed, task.most_acceleration,
                          task.most_jerk};
  const bool back = task.speed + task.acceleration * std::abs(task.acceleration) / (2 * task.most_jerk) < 0;
  const RestTask& towards = back ? mirrored : task;
  const State s{0, towards.speed, towards.acceleration};
  const bool beyond = stop(s, towards).end.x > towards.way;
  return forward(beyond == back ? task : mirrored, steps);
}

}  // namespace indurop::robot
