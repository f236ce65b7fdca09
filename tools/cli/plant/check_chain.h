// SPDX-License-Identifier: Apache-2.0
// indurop check --chain: the chains from one variable to another through modules and boards, and the age of the data at
// their end.

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "core/base/duration.h"
#include "tools/cli/command/verb.h"
#include "tools/cli/plant/chains.h"

namespace indurop::tools {

struct ChainQuestion {
  std::string from;
  std::string to;
  // Maximum time from board to board; empty: what boards of the plant that run on this machine measure, else
  // config::kNetworkHop.
  std::optional<base::Nanos> network;
};

// Maximum time from board to board, and its source.
struct NetworkTime {
  base::Nanos most{};
  bool given = false;
  bool measured = false;
};
NetworkTime network_time(std::span<const config::BoardView> boards, const std::optional<base::Nanos>& given);
std::string network_words(const NetworkTime& network);
// Returns the maximum time of a beacon between boards that run on this machine, including the uncertainty of their
// clocks.
std::optional<base::Nanos> measured_network(std::span<const config::BoardView> boards);
std::string microseconds(base::Nanos time);

// Returns nothing, after a message, if a variable is unknown, or no chain leads from one to the other.
std::optional<std::vector<Chain>> find_chains(Context& context, const ChainPlant& plant, const std::string& from,
                                              const std::string& to);

// Returns the exit code.
int check_chain(Context& context, const std::string& file, const config::CheckOptions& options,
                const ChainQuestion& question);

}  // namespace indurop::tools
