// SPDX-License-Identifier: Apache-2.0
// What the counters mean that a module built with --coverage keeps.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plc/model/place.h"

namespace indurop::plc {

struct CoverageTable {
  enum class Kind : std::uint8_t {
    Statement,  // one counter: how often it ran
    Branch,     // two: how often the condition was true, how often false
    Coil,       // two: how often it had power, how often not
  };
  struct Point {
    Kind kind{};
    std::uint32_t counter = 0;  // the first one
    Place at;
    std::string pou;  // "PROGRAM main"
  };
  std::vector<Point> points;
  std::uint32_t counters = 0;

  // The number of its first counter.
  std::uint32_t add(Kind kind, const Place& at, std::string pou) {
    points.push_back({kind, counters, at, std::move(pou)});
    counters += kind == Kind::Statement ? 1U : 2U;
    return points.back().counter;
  }
};

// A line for each point: kind ("statement", "branch", "coil"), first counter, file, line, what is drawn there, POU,
// with tabs between them.
[[nodiscard]] std::string to_text(const CoverageTable& table);

}  // namespace indurop::plc
