// SPDX-License-Identifier: Apache-2.0
#include "config/pool_arguments.h"

#include <algorithm>
#include <set>

#include "core/base/duration.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

bool gets(const PoolRoute& route, const std::string& board) {
  return std::find(route.to.begin(), route.to.end(), board) != route.to.end();
}

const Board* board_named(const Plant& plant, const std::string& name) {
  const auto found =
      std::find_if(plant.boards.begin(), plant.boards.end(), [&name](const Board& one) { return one.name == name; });
  return found == plant.boards.end() ? nullptr : &*found;
}

// Returns the boards at the other ends of the board's pools, in the order of the manifest.
std::vector<const Board*> partners_of(const Plant& plant, const std::string& board) {
  std::set<std::string> names;
  for (const PoolRoute& route : plant.pools) {
    if (route.from == board) {
      names.insert(route.to.begin(), route.to.end());
    } else if (gets(route, board)) {
      names.insert(route.from);
    }
  }
  std::vector<const Board*> partners;
  for (const Board& one : plant.boards) {
    if (names.contains(one.name)) {
      partners.push_back(&one);
    }
  }
  return partners;
}

}  // namespace

std::vector<BoardPool> pools_of(const Plant& plant, const std::string& board) {
  std::vector<BoardPool> pools;
  for (const PoolRoute& route : plant.pools) {
    if (route.from == board) {
      const std::string limit =
          route.every > base::Nanos::zero() ? ", at most every " + base::format_duration(route.every) : "";
      pools.push_back({route.name, "sent to " + base::enumerate(route.to) + limit});
    } else if (gets(route, board)) {
      pools.push_back({route.name, "received from " + route.from});
    }
  }
  return pools;
}

std::vector<std::string> pool_arguments(const Plant& plant, const std::string& board, bool one_host) {
  const Board* const own = board_named(plant, board);
  std::vector<std::string> words;
  for (const PoolRoute& route : plant.pools) {
    if (route.from == board) {
      const std::string every =
          route.every > base::Nanos::zero() ? "@" + std::to_string(route.every.count()) + "ns" : "";
      words.insert(words.end(), {"--send", route.name + every});
    } else if (gets(route, board)) {
      words.insert(words.end(), {"--receive", route.name});
    }
  }
  if (words.empty() || own == nullptr) {
    return {};
  }
  // Tools find pools where they find variables. Without such a domain, pools are in that of the boards.
  words.insert(words.begin(), {"--node", board, "--plant", plant.name, "--domain",
                               std::to_string(plant.external_domain.value_or(plant.domain))});
  if (one_host) {
    words.emplace_back("--one-host");
    return words;
  }
  if (!own->interface_name.empty()) {
    words.insert(words.end(), {"--interface", own->interface_name});
  }
  if (!own->address.empty()) {
    words.insert(words.end(), {"--address", own->address});
  }
  for (const Board* partner : partners_of(plant, board)) {
    if (!partner->address.empty()) {
      words.insert(words.end(), {"--peer", partner->address});
    }
  }
  return words;
}

}  // namespace indurop::config
