// SPDX-License-Identifier: Apache-2.0
// indurop-pools of all boards of a plant that runs on this host without agents.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "config/model/plant.h"
#include "tools/console/context.h"

namespace indurop::tools {

class LocalPools {
 public:
  explicit LocalPools(Context& context) : context_(context) {}
  LocalPools(const LocalPools&) = delete;
  LocalPools& operator=(const LocalPools&) = delete;
  ~LocalPools() { end(); }

  // Starts one for each board that sends or receives a pool; `folder` has the program. One that cannot be started is
  // reported: the boards run without it.
  void start(const config::Plant& plant, const std::filesystem::path& folder);
  // Reports those that have ended; they are not started again.
  void collect();
  // Ends all and waits for them, at most for some seconds.
  void end();

 private:
  struct Program {
    std::string board;
    pid_t pid = -1;
  };

  Context& context_;
  std::vector<Program> programs_;
};

}  // namespace indurop::tools
