// SPDX-License-Identifier: Apache-2.0
// What a shadow run of a module found: where its outputs differ from those of the version that runs, and what a run
// costs. Made from the report of indurop-node --replay-report.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/shadow/accepted_differences.h"
#include "tools/console/context.h"

namespace indurop::tools {

struct ShadowVariable {
  std::string name;
  std::uint64_t compared = 0;   // runs
  std::uint64_t differing = 0;  // of these
  std::uint64_t unclear = 0;    // runs that differ, perhaps because inputs changed while they or earlier ones ran
  std::uint64_t first_tick = 0;
  std::string first_part;  // what differed first, and its values in the node and in the shadow
  std::string first_was;
  std::string first_is;
  double largest = 0;  // difference; infinite: it is no number, or was not compared
  std::string largest_part;

  [[nodiscard]] bool is_equal() const noexcept { return compared > 0 && differing == 0 && unclear == 0; }
};

struct ShadowTimes {
  std::int64_t median_ns = 0;
  std::int64_t p99_ns = 0;
  std::int64_t max_ns = 0;
};

struct ShadowReport {
  std::string module;
  std::uint64_t runs = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t disturbed_runs = 0;  // their inputs changed while they ran
  std::string initial_values;        // why the shadow began with initial values; empty: with what the module keeps
  std::string fault;                 // empty: it did not fault
  std::uint64_t fault_tick = 0;
  bool only_recorded_fault = false;  // the version that runs faulted, and the shadow did not
  ShadowTimes now;                   // processor time of its runs
  ShadowTimes then;                  // of the version that runs, in the node
  std::vector<ShadowVariable> variables;
  std::vector<std::string> added;      // that the node does not have: nothing is compared with them
  std::vector<std::string> converted;  // that the node has with another type
  JsonValue json;                      // as it was read
};

// Returns nothing if the text is not such a report.
std::optional<ShadowReport> read_shadow_report(const std::string& text);

// Returns why the new version is not to be exchanged, in one sentence; nothing: it may be. `lossy`: it may begin with
// initial values.
std::optional<std::string> objection(const ShadowReport& report, const AcceptedDifferences& accepted, bool lossy);

void print_shadow(Context& context, const ShadowReport& report);

}  // namespace indurop::tools
