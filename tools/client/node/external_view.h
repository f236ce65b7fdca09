// SPDX-License-Identifier: Apache-2.0
// The view of a node that third-party tools have, as the node shows it in shared memory.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/client/text/table.h"

namespace indurop::tools {

struct ExternalView {
  int domain = 0;
  bool up = false;
  std::string problem;
  std::uint32_t topics = 0;
  std::uint32_t writable = 0;
  std::uint32_t read = 0;
  std::uint64_t samples = 0;
  std::uint64_t unsendable = 0;
  std::uint64_t received = 0;
  std::uint64_t refused = 0;
  std::uint64_t mismatched = 0;
  std::int64_t cycle_max_ns = 0;
};

// Returns nothing if the node shows nothing to third-party tools, or its file is invalid.
std::optional<ExternalView> view_external(const std::string& node);
JsonValue json_of(const ExternalView& view);

}  // namespace indurop::tools
