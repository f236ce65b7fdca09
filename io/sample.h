// SPDX-License-Identifier: Apache-2.0
// The value of one point between a driver and its variable: a number as the device has it, and how good it is.

#pragma once

#include <cstdint>

namespace indurop::io {

// What a point's quality variable holds. A bool variable is true for Good only.
enum class Quality : std::uint8_t {
  None = 0,     // nothing was exchanged yet
  Good = 1,     // as of the last exchange
  Lost = 2,     // the device does not answer: no connection, time-out, garbage
  Refused = 3,  // the device answered that it does not have this point
  OutOfRange =
      4,  // the variable (an output: the wire) cannot hold the value; it has its nearest one; or it is NaN or Inf
  NotRefreshed = 5  // an output that is not sent any more, because the tick stands still
};

// Wide enough for every whole number of 64 bits and every double.
using Number = long double;

struct Sample {
  Number value = 0;
  Quality quality = Quality::None;
};

}  // namespace indurop::io
