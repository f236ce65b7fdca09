// SPDX-License-Identifier: Apache-2.0
// Function blocks SR RS SEMA and R_TRIG F_TRIG. Inputs and outputs are members with the names of the standard in lower
// case; a call with the scan evaluates the block. Real-time safe.

#pragma once

#include <indurop/plc/scan.h>

namespace indurop::iec {

// Set dominates.
struct Sr {
  bool s1 = false;
  bool r = false;
  bool q1 = false;

  void operator()(const Scan& /*scan*/) noexcept { q1 = s1 || (!r && q1); }
};

// Reset dominates.
struct Rs {
  bool s = false;
  bool r1 = false;
  bool q1 = false;

  void operator()(const Scan& /*scan*/) noexcept { q1 = !r1 && (s || q1); }
};

// If `busy` is false after a claim, the caller has the semaphore until it releases it.
struct Sema {
  bool claim = false;
  bool release = false;
  bool busy = false;

  void operator()(const Scan& /*scan*/) noexcept {
    busy = taken_;
    if (claim) {
      taken_ = true;
    } else if (release) {
      busy = false;
      taken_ = false;
    }
  }
  void restore(const Scan& /*scan*/) noexcept { taken_ = busy || claim; }

 private:
  bool taken_ = false;
};

// A `clk` that is true at the first call is an edge.
struct RTrig {
  bool clk = false;
  bool q = false;

  void operator()(const Scan& /*scan*/) noexcept {
    q = clk && !memory_;
    memory_ = clk;
  }
  void restore(const Scan& /*scan*/) noexcept { memory_ = clk; }

 private:
  bool memory_ = false;
};

// As the standard specifies, a `clk` that is false at the first call is an edge.
struct FTrig {
  bool clk = false;
  bool q = false;

  void operator()(const Scan& /*scan*/) noexcept {
    q = !clk && !memory_;
    memory_ = !clk;
  }
  void restore(const Scan& /*scan*/) noexcept { memory_ = !clk; }

 private:
  bool memory_ = false;
};

namespace detail {
// The rising edge of an input declared R_EDGE.
class Edge {
 public:
  bool rises(bool input) noexcept {
    const bool edge = input && !memory_;
    memory_ = input;
    return edge;
  }
  void restore(bool input) noexcept { memory_ = input; }

 private:
  bool memory_ = false;
};
}  // namespace detail

}  // namespace indurop::iec
