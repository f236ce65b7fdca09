// SPDX-License-Identifier: Apache-2.0
// A recording of boards that do not all run on this host: their agents record them meanwhile, and everything is joined
// in one file on a common time axis.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct BoardElsewhere {
  std::string name;
  std::string why;  // why it is not recorded locally, though it runs on this host; else empty
};
struct RecordRequest {
  std::string plant;
  std::vector<BoardElsewhere> boards;
  std::vector<std::string> names;  // variables or globs to record; none: all
  bool past = false;
  std::int64_t duration_ns = 0;  // if nothing is recorded locally; 0: until the user ends it
  std::filesystem::path file;    // must not exist
};

// Starts the recordings of the agents, calls `here` with a file for what this host records (empty: nothing), and when
// that returns, ends the others and joins all. `unmatched`: the requested names that no board of this host has.
// Returns the exit code of the first problem; boards that are missing in the file are named.
int record_with_agents(Context& context, const RecordRequest& request, deploy::LinkSettings& link,
                       const std::vector<std::string>& unmatched,
                       const std::function<int(const std::filesystem::path& file)>& here);

}  // namespace indurop::tools
