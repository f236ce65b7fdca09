// SPDX-License-Identifier: Apache-2.0
// The option --keys of verbs that communicate with boards: the keys by which the boards know them.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/options.h"
#include "core/base/problem.h"
#include "core/keys/participant_keys.h"
#include "deploy/link/deploy_link.h"
#include "network/dds/network_settings.h"

namespace indurop::deploy {

dds::Security security_of(const keys::ParticipantKeys& keys);

// Uses the keys in settings.keys from now on: those of the deployer, if it is the folder of a plant.
Result<void, base::Problem> use_keys(LinkSettings& settings);

// Adds --keys DIR, which sets `security` to the keys in it (keys::resolve_keys); a folder without keys is a usage
// error. `given`, if not null, is set to that folder.
base::Option add_keys_option(base::Options& line, dds::Security& security, keys::Role role, const std::string& help,
                             std::filesystem::path* given = nullptr);

}  // namespace indurop::deploy
