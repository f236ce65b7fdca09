// SPDX-License-Identifier: Apache-2.0
// Function blocks TP TON TOF BLINK and RTC. `pt` may change while a timer runs and takes effect at once; negative
// counts as zero. A timer ends in the first scan whose time reaches `pt`; `et` then stays at `pt`. Real-time safe.

#pragma once

#include <indurop/plc/calendar.h>
#include <indurop/plc/scan.h>

#include <algorithm>

namespace indurop::iec {

// A pulse of length `pt` at the rising edge of `in`, which has no further effect until the pulse has ended.
struct Tp {
  bool in = false;
  Time pt;
  bool q = false;
  Time et;

  void operator()(const Scan& scan) noexcept {
    if (in && !before_ && !q) {
      watch_.start(scan);
      q = true;
    }
    before_ = in;
    if (q) {
      const Time end = std::max(pt, Time{});
      const Time elapsed = watch_.elapsed(scan);
      q = elapsed < end;
      et = std::min(elapsed, end);
    }
    if (!q && !in) {
      et = {};
    }
  }
  void restore(const Scan& scan) noexcept {
    before_ = in;
    watch_.resume(scan, et);
  }

 private:
  detail::Stopwatch watch_;
  bool before_ = false;
};

// On-delay: `q` rises when `in` was true for `pt`; it falls with `in`.
struct Ton {
  bool in = false;
  Time pt;
  bool q = false;
  Time et;

  void operator()(const Scan& scan) noexcept {
    if (!in) {
      q = false;
      et = {};
      running_ = false;
      return;
    }
    if (!running_) {
      watch_.start(scan);
      running_ = true;
    }
    if (!q) {
      const Time end = std::max(pt, Time{});
      const Time elapsed = watch_.elapsed(scan);
      q = elapsed >= end;
      et = std::min(elapsed, end);
    }
  }
  void restore(const Scan& scan) noexcept {
    running_ = in;
    watch_.resume(scan, et);
  }

 private:
  detail::Stopwatch watch_;
  bool running_ = false;
};

// Off-delay: `q` rises with `in` and falls when `in` was false for `pt`.
struct Tof {
  bool in = false;
  Time pt;
  bool q = false;
  Time et;

  void operator()(const Scan& scan) noexcept {
    if (in) {
      q = true;
      et = {};
      running_ = false;
      return;
    }
    if (q && !running_) {
      watch_.start(scan);
      running_ = true;
    }
    if (q) {
      const Time end = std::max(pt, Time{});
      const Time elapsed = watch_.elapsed(scan);
      q = elapsed < end;
      et = std::min(elapsed, end);
    }
  }
  void restore(const Scan& scan) noexcept {
    running_ = q && !in;
    watch_.resume(scan, et);
  }

 private:
  detail::Stopwatch watch_;
  bool running_ = false;
};

// BLINK of the library Util: while `enable` is true, `out` alternates between true for `timehigh` and false for
// `timelow`, true first. It keeps its value when `enable` falls.
struct Blink {
  bool enable = false;
  Time timelow;
  Time timehigh;
  bool out = false;

  void operator()(const Scan& scan) noexcept {
    const bool begins = enable && !running_;
    running_ = enable;
    if (enable && (begins || watch_.elapsed(scan) >= std::max(out ? timehigh : timelow, Time{}))) {
      watch_.start(scan);
      out = begins || !out;
    }
  }
  // The time of the present output starts again.
  void restore(const Scan& scan) noexcept {
    running_ = enable;
    watch_.start(scan);
  }

 private:
  detail::Stopwatch watch_;
  bool running_ = false;
};

// The clock `cdt` is set to `pdt` at the rising edge of `in` and runs with the schedule while `in` is true.
struct Rtc {
  bool in = false;
  DateTime pdt;
  bool q = false;
  DateTime cdt;

  void operator()(const Scan& scan) noexcept {
    if (in && !q) {
      watch_.start(scan);
      preset_ = pdt;
    }
    q = in;
    if (in) {
      cdt = add(preset_, watch_.elapsed(scan));
    }
  }

 private:
  detail::Stopwatch watch_;
  DateTime preset_;
};

}  // namespace indurop::iec
