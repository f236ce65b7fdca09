// SPDX-License-Identifier: Apache-2.0
// Executes a deployment on all its boards: shared by deploy and rollback.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "deploy/link/blob_server.h"
#include "deploy/link/deploy_link.h"
#include "deploy/transaction/plant_transaction.h"
#include "deploy/words/deployment_words.h"
#include "tools/cli/command/verb.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

struct Deployment {
  deploy::Order order;  // who, what, for whom
  std::string key;      // private key that signs the commands; empty: unsigned
  deploy::BlobServer::Find files;
  std::int64_t patience_ns = 0;                                     // maximum time without any progress
  std::chrono::nanoseconds lost = deploy::PlantTransaction::kLost;  // time that a lost board has to come back
  JsonValue head;                                                   // of the result as JSON
  std::string title;                                                // "plant cell, deployment 0123456789ab"
};

// Prints progress and the result; returns the exit code.
int run_deployment(Context& context, deploy::DeployLink& link, BoardRoster& roster, Deployment deployment);

// Returns a generation above all those reported.
std::uint64_t next_generation(const BoardRoster& roster);
// Returns those of `wanted` that are present, at least one. Fails if some are missing (and `allow_missing` is not set),
// or two have the same name.
Result<std::vector<std::string>, Failure> present_boards(Context& context, deploy::DeployLink& link,
                                                         BoardRoster& roster, const std::vector<std::string>& wanted,
                                                         bool allow_missing, std::int64_t timeout_ns);

}  // namespace indurop::tools
