// SPDX-License-Identifier: Apache-2.0
// The value of one point between a driver and its variable: the number in the device's units, and its quality.

#pragma once

#include <cstdint>

namespace indurop::io {

// Values of a point's quality variable. A bool quality variable is true for Good only.
enum class Quality : std::uint8_t {
  None = 0,     // nothing was exchanged yet
  Good = 1,     // as of the last exchange
  Lost = 2,     // the device does not answer: no connection, time-out, invalid data
  Refused = 3,  // the device answered that it does not have this point
  OutOfRange =
      4,  // the variable (an output: the wire) cannot hold the value; it has its nearest one; or it is NaN or Inf
  NotRefreshed = 5,  // an output that is no longer sent, because the tick has stopped
  Reported = 6       // the device itself reports that the value is bad or uncertain
};

// Can hold every 64-bit integer and every double.
using Number = long double;

struct Sample {
  Number value = 0;
  Quality quality = Quality::None;
};

}  // namespace indurop::io
