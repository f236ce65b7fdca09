// SPDX-License-Identifier: Apache-2.0
// indurop check --chain: the ways from one variable to another over modules and boards, and how old what goes along
// them is at the end.

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/duration.h"
#include "config/check/check.h"
#include "tools/command/verb.h"
#include "tools/plant/chains.h"

namespace indurop::tools {

struct ChainQuestion {
  std::string from;
  std::string to;
  // What a way from board to board takes at most; empty: what boards of the plant that run on this machine measure,
  // else config::kNetworkHop.
  std::optional<base::Nanos> network;
};

// What a way from board to board takes at most, and how that is known.
struct NetworkTime {
  base::Nanos most{};
  bool told = false;
  bool measured = false;
};
NetworkTime network_time(std::span<const config::BoardView> boards, const std::optional<base::Nanos>& told);
std::string network_words(const NetworkTime& network);
// The longest that a beacon was under way between boards that run on this machine, with what is not known of the
// clocks.
std::optional<base::Nanos> measured_network(std::span<const config::BoardView> boards);
std::string microseconds(base::Nanos time);

// Empty, after a message: a variable is not known, or nothing leads from one to the other.
std::optional<std::vector<Chain>> find_chains(Context& context, const ChainPlant& plant, const std::string& from,
                                              const std::string& to);

// Returns the exit code.
int check_chain(Context& context, const std::string& file, const config::CheckOptions& options,
                const ChainQuestion& question);

}  // namespace indurop::tools
