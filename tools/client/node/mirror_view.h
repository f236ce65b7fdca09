// SPDX-License-Identifier: Apache-2.0
// A board's mirror as its node shows it in shared memory: the other boards, their variables and the age of the values.

#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "network/mirror/frames/mirrored_variables.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

struct PeerView {
  std::string name;
  std::string state;
  std::string problem;
  std::uint32_t wanted = 0;
  std::int64_t heard_ns = 0;  // time since the last message; negative: never
  std::uint64_t frames = 0;
  std::uint64_t lost_updates = 0;
  std::uint64_t refused = 0;
  std::uint64_t losses = 0;
  std::int64_t delay_ns = 0;
  std::uint64_t tick = 0;
  bool clock_known = false;
  std::int64_t clock_offset_ns = 0;  // own clock minus that of the other board
  std::int64_t clock_bound_ns = 0;
  bool clock_synchronised = false;
  std::int64_t epoch_wall_ns = 0;  // time of its tick 0
};

struct MirrorView {
  std::string plant;
  std::string board;
  int domain = 0;
  bool up = false;
  std::string problem;
  std::uint32_t outgoing = 0;
  std::uint32_t parts = 0;
  std::uint64_t frames = 0;
  std::uint64_t bytes = 0;
  std::uint64_t send_errors = 0;
  std::int64_t cycle_ns = 0;
  std::int64_t cycle_max_ns = 0;
  bool clock_synchronised = false;
  std::int64_t clock_error_ns = 0;
  std::int64_t epoch_wall_ns = 0;
  std::vector<PeerView> peers;
  std::vector<mirror::MirroredVariable> variables;
};

// Returns nothing if the node is not a board of a plant, or its file is invalid.
std::optional<MirrorView> view_mirror(const std::string& node);
// For each board in these variables that is not being received: returns why its values are old, and which ones.
std::vector<std::string> explain_old(const MirrorView& view, const std::set<std::string>& variables);
JsonValue json_of(const std::vector<mirror::MirroredVariable>& variables);
JsonValue json_of(const MirrorView& view);

}  // namespace indurop::tools
