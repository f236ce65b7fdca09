// SPDX-License-Identifier: Apache-2.0
// Exchanges the code of a module of a board in the network, through its agent: the new file is sent from here.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "deploy/link/deploy_link.h"
#include "store/operate/remote_reload.h"
#include "tools/cli/command/verb.h"
#include "tools/client/failure.h"

namespace indurop::tools {

struct RemoteReloadOrder {
  std::string board;
  std::string module;
  std::filesystem::path file;  // on this machine; empty: back to the previous version
  operate::ReloadRequest request;
  std::int64_t timeout_ns = 0;  // in addition to the health window
  deploy::LinkSettings link;
};

// Waits until the new version has settled on the board, or the previous one runs again. Errors: the file cannot be
// read, the board was not discovered, refuses the command or has not answered.
Result<operate::RemoteReloadReply, Failure> reload_on_board(Context& context, RemoteReloadOrder& order);

}  // namespace indurop::tools
