// SPDX-License-Identifier: Apache-2.0
// Function blocks CTU CTD CTUD and their variants for other integers, CTU_DINT .... They count rising edges and stop at
// the limits of the type. Real-time safe.

#pragma once

#include <indurop/plc/bistables.h>

#include <limits>

namespace indurop::iec {

template <Integer T>
struct Ctu {
  bool cu = false;
  bool r = false;
  T pv = 0;
  bool q = false;
  T cv = 0;

  void operator()(const Scan& /*scan*/) noexcept {
    const bool up = up_.rises(cu);
    if (r) {
      cv = 0;
    } else if (up && cv < std::numeric_limits<T>::max()) {
      ++cv;
    }
    q = cv >= pv;
  }
  void restore(const Scan& /*scan*/) noexcept { up_.restore(cu); }

 private:
  detail::Edge up_;
};

template <Integer T>
struct Ctd {
  bool cd = false;
  bool ld = false;
  T pv = 0;
  bool q = false;
  T cv = 0;

  void operator()(const Scan& /*scan*/) noexcept {
    const bool down = down_.rises(cd);
    if (ld) {
      cv = pv;
    } else if (down && cv > std::numeric_limits<T>::min()) {
      --cv;
    }
    q = cv <= 0;
  }
  void restore(const Scan& /*scan*/) noexcept { down_.restore(cd); }

 private:
  detail::Edge down_;
};

// Priority: reset, load, counting; edges on both inputs at the same time cancel each other.
template <Integer T>
struct Ctud {
  bool cu = false;
  bool cd = false;
  bool r = false;
  bool ld = false;
  T pv = 0;
  bool qu = false;
  bool qd = false;
  T cv = 0;

  void operator()(const Scan& /*scan*/) noexcept {
    const bool up = up_.rises(cu);
    const bool down = down_.rises(cd);
    if (r) {
      cv = 0;
    } else if (ld) {
      cv = pv;
    } else if (up && !down && cv < std::numeric_limits<T>::max()) {
      ++cv;
    } else if (down && !up && cv > std::numeric_limits<T>::min()) {
      --cv;
    }
    qu = cv >= pv;
    qd = cv <= 0;
  }
  void restore(const Scan& /*scan*/) noexcept {
    up_.restore(cu);
    down_.restore(cd);
  }

 private:
  detail::Edge up_;
  detail::Edge down_;
};

}  // namespace indurop::iec
