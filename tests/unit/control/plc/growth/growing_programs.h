// SPDX-License-Identifier: Apache-2.0
// Texts that grow with a number: each has n of something of which a compiler may compare each with each other, or
// that lies inside of itself n times.

#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace indurop::plc::testing {

struct GrowingText {
  const char* name;
  std::string (*text)(std::size_t n);
  std::size_t first = 400;     // the smaller n of a measurement
  const char* file = "in.st";  // its ending says what it is
};

[[nodiscard]] std::span<const GrowingText> growing_texts();

}  // namespace indurop::plc::testing
