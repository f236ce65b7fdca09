// SPDX-License-Identifier: Apache-2.0
// A recording of boards that do not all run on this host: their agents record them meanwhile, and all of it becomes one
// file on common time.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/command/verb.h"

namespace indurop::tools {

struct BoardElsewhere {
  std::string name;
  std::string why;  // it is not recorded here, though it runs here; else empty
};
struct RemoteWish {
  std::string plant;
  std::vector<BoardElsewhere> boards;
  std::vector<std::string> names;  // wanted variables or globs; none: all
  bool past = false;
  std::int64_t duration_ns = 0;  // if nothing is recorded here; 0: until the user ends it
  std::filesystem::path file;    // must not be there
};

// Begins what agents are to record, calls `here` with a file for what this host records (empty: nothing), and when that
// returns, ends the others and joins all. `nobody_has`: the wanted names that no board of this host has. Returns the
// exit code of the first problem; boards that are not in the file are named.
int record_with_agents(Context& context, const RemoteWish& wish, deploy::LinkSettings& link,
                       const std::vector<std::string>& nobody_has,
                       const std::function<int(const std::filesystem::path& file)>& here);

}  // namespace indurop::tools
