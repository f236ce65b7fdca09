// SPDX-License-Identifier: Apache-2.0
// Function blocks from the standard's examples that editors bring along: HYSTERESIS INTEGRAL DERIVATIVE PID RAMP. Their
// input CYCLE is the time between two calls; if it is not connected (zero), it is taken from the schedule. Times are in
// seconds. Real-time safe.

#pragma once

#include <indurop/plc/calendar.h>
#include <indurop/plc/scan.h>

namespace indurop::iec {

namespace detail {

constexpr double seconds(Time time) noexcept {
  return static_cast<double>(time.ns) / static_cast<double>(kSecond);
}

// The time between two calls: `cycle`, or if it is zero the time since the last call; zero at the first one.
class Step {
 public:
  [[nodiscard]] Time next(const Scan& scan, Time cycle) noexcept {
    const Time passed = called_ ? watch_.elapsed(scan) : Time{};
    watch_.start(scan);
    called_ = true;
    return cycle.ns != 0 ? cycle : passed;
  }

 private:
  Stopwatch watch_;
  bool called_ = false;
};

}  // namespace detail

// Comparison of xin1 with xin2 that ignores changes within +-eps.
struct Hysteresis {
  float xin1 = 0;
  float xin2 = 0;
  float eps = 0;
  bool q = false;

  void operator()(const Scan& /*scan*/) noexcept { q = q ? !(xin1 < xin2 - eps) : xin1 > xin2 + eps; }
};

// xout = x0 + the integral of xin over the time while run is true; r1 sets it to x0. Summed in double precision, so
// that slow signals are not lost at short periods.
struct Integral {
  bool run = false;
  bool r1 = false;
  float xin = 0;
  float x0 = 0;
  Time cycle;
  bool q = false;
  float xout = 0;

  void operator()(const Scan& scan) noexcept {
    const Time step = step_.next(scan, cycle);
    q = !r1;
    if (r1) {
      sum_ = static_cast<double>(x0);
    } else if (run) {
      sum_ += static_cast<double>(xin) * detail::seconds(step);
    }
    xout = static_cast<float>(sum_);
  }

 private:
  detail::Step step_;
  double sum_ = 0;
};

// The rate of change of xin per second over the last four values. If no time has passed it keeps its output.
struct Derivative {
  bool run = false;
  float xin = 0;
  Time cycle;
  float xout = 0;

  void operator()(const Scan& scan) noexcept {
    const double step = detail::seconds(step_.next(scan, cycle));
    if (!run) {
      xout = 0;
      x1_ = x2_ = x3_ = xin;
      return;
    }
    if (step > 0) {
      xout = static_cast<float>(static_cast<double>(3 * (xin - x3_) + x1_ - x2_) / (10 * step));
    }
    x3_ = x2_;
    x2_ = x1_;
    x1_ = xin;
  }

 private:
  detail::Step step_;
  float x1_ = 0;
  float x2_ = 0;
  float x3_ = 0;
};

// xout = kp * (e + integral(e) / tr + td * derivative(e)) with e = pv - sp. In manual mode (automatic false): xout = kp
// * x0, and the integral is prepared for a bumpless change to automatic. tr = 0 disables the integral.
struct Pid {
  bool automatic = false;  // the input AUTO, which is a keyword of C++
  float pv = 0;
  float sp = 0;
  float x0 = 0;
  float kp = 0;
  float tr = 0;
  float td = 0;
  Time cycle;
  float xout = 0;

  void operator()(const Scan& scan) noexcept {
    const float error = pv - sp;
    integral_.run = automatic;
    integral_.r1 = !automatic;
    integral_.xin = error;
    integral_.x0 = tr * (x0 - error);
    integral_.cycle = cycle;
    integral_(scan);
    derivative_.run = automatic;
    derivative_.xin = error;
    derivative_.cycle = cycle;
    derivative_(scan);
    if (tr != 0) {
      xout = kp * (error + integral_.xout / tr + derivative_.xout * td);
    } else {
      xout = kp * (automatic ? error + derivative_.xout * td : x0);
    }
  }

 private:
  Integral integral_;
  Derivative derivative_;
};

// Ramps from x0 to x1 in the time tr while run is true; else xout follows x0.
struct Ramp {
  bool run = false;
  float x0 = 0;
  float x1 = 0;
  Time tr;
  Time cycle;
  bool busy = false;
  float xout = 0;

  void operator()(const Scan& scan) noexcept {
    const Time step = step_.next(scan, cycle);
    if (run && running_ && passed_ < tr) {
      passed_ = add(passed_, step);
    }
    running_ = run;
    busy = run && passed_ < tr;
    if (!run) {
      xout = from_ = x0;
      passed_ = {};
    } else if (!busy) {
      xout = x1;
    } else {
      xout = static_cast<float>(static_cast<double>(from_) + static_cast<double>(x1 - from_) *
                                                                 static_cast<double>(passed_.ns) /
                                                                 static_cast<double>(tr.ns));
    }
  }

 private:
  detail::Step step_;
  bool running_ = false;
  float from_ = 0;
  Time passed_;
};

}  // namespace indurop::iec
