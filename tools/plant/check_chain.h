// SPDX-License-Identifier: Apache-2.0
// indurop check --chain: the ways from one variable to another over modules and boards, and how old what goes along
// them is at the end.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/duration.h"
#include "config/check/check.h"
#include "tools/command/verb.h"

namespace indurop::tools {

struct ChainQuestion {
  std::string from;
  std::string to;
  // What a way from board to board takes at most; empty: what boards of the plant that run on this machine measure,
  // else config::kNetworkHop.
  std::optional<base::Nanos> network;
};

// Returns the exit code.
int check_chain(Context& context, const std::string& file, const config::CheckOptions& options,
                const ChainQuestion& question);

}  // namespace indurop::tools
