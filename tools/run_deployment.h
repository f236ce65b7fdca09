// SPDX-License-Identifier: Apache-2.0
// Takes a deployment through on all its boards: what deploy and rollback have in common.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "deploy/deployment_words.h"
#include "mirror/blob_server.h"
#include "mirror/deploy_link.h"
#include "tools/board_roster.h"
#include "tools/table.h"
#include "tools/verb.h"

namespace indurop::tools {

struct Deployment {
  deploy::Order order;  // who, what, for whom
  std::string key;      // private key that signs orders; empty: unsigned
  mirror::BlobServer::Find files;
  std::int64_t patience_ns = 0;  // how long nothing at all may happen
  JsonValue head;                // of the result as JSON
  std::string title;             // "plant cell, deployment 0123456789ab"
};

// Prints progress and the result; returns the exit code.
int run_deployment(Context& context, mirror::DeployLink& link, BoardRoster& roster, Deployment deployment);

// Private key of the deployer in a folder of keys (indurop keys init). False after an error message: it cannot be read.
// An empty folder is no error: no key.
bool read_deploy_key(Context& context, const std::filesystem::path& folder, std::string& key);
// A generation above all those heard.
std::uint64_t next_generation(const BoardRoster& roster);
// Those boards of `wanted` that are there. Empty after an error: some are missing (and `allow_missing` is not set), or
// two have one name; `code` is the exit code then.
std::vector<std::string> present_boards(Context& context, mirror::DeployLink& link, BoardRoster& roster,
                                        const std::vector<std::string>& wanted, bool allow_missing,
                                        std::int64_t timeout_ns, int& code);

}  // namespace indurop::tools
