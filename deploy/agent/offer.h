// SPDX-License-Identifier: Apache-2.0
// The blobs that an agent offers by name: its deployments' files, and texts about the board.

#pragma once

#include <optional>
#include <string>

#include "deploy/agent/agent_state.h"
#include "deploy/agent/board_pools.h"
#include "deploy/agent/board_users.h"
#include "deploy/agent/board_values.h"
#include "deploy/agent/board_verify.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/link/blob_server.h"

namespace indurop::deploy {

// What the blobs are made from; all references are borrowed.
struct Offered {
  const std::string& board;
  const AgentState& state;
  BoardValues& values;
  BoardVerify& verify;
  const BoardPools& pools;
  const BoardUsers& users;
  const DeployKeys& keys;
};
// Returns nothing if there is no blob of that name.
std::optional<BlobServer::Blob> offer(const std::string& name, const Offered& from);

}  // namespace indurop::deploy
