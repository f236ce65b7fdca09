// SPDX-License-Identifier: Apache-2.0
// The meaning of the counters of a module built with --coverage.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "control/plc/model/source_place.h"

namespace indurop::plc {

struct CoverageTable {
  enum class Kind : std::uint8_t {
    Statement,  // one counter: how often it ran
    Branch,     // two: how often the condition was true, how often false
    Coil,       // two: how often it had power, and how often not
  };
  struct Point {
    Kind kind{};
    std::uint32_t counter = 0;  // the first one
    Place at;
    std::string pou;  // "PROGRAM main"
  };
  std::vector<Point> points;
  std::uint32_t counters = 0;

  // Adds a point; returns the number of its first counter.
  std::uint32_t add(Kind kind, const Place& at, std::string pou) {
    points.push_back({kind, counters, at, std::move(pou)});
    counters += kind == Kind::Statement ? 1U : 2U;
    return points.back().counter;
  }
};

// Returns a line for each point: kind ("statement", "branch", "coil"), first counter, file, line, drawn element, POU,
// separated by tabs.
[[nodiscard]] std::string to_text(const CoverageTable& table);

}  // namespace indurop::plc
