// SPDX-License-Identifier: Apache-2.0
// DDS Security of a participant: its configuration, the plugins it needs, and checks in advance.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "network/dds/network_settings.h"

namespace indurop::dds {

// Returns the folder of Cyclone's three plugins: next to the loaded library. Empty: they do not exist.
std::filesystem::path security_plugins();
// Returns <Security> for the domain's configuration; empty for an open plant.
std::string security_configuration(const Security& security, const std::filesystem::path& plugins);

// Errors: the plugins do not exist, or a file cannot be read; with what to do about it.
Result<void, base::Problem> security_usable(const Security& security, const std::filesystem::path& plugins);

}  // namespace indurop::dds
