// SPDX-License-Identifier: Apache-2.0
// Derives the settings of one board's mirror from a checked plant and its schedule. Pure translation.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/check/check_plant.h"
#include "network/mirror/frames/settings.h"
#include "scheduler/engine.h"

namespace indurop::node {

// The keys of a board; off in a plant without keys.
dds::Security board_security(const config::Plant& plant, const std::string& board);
// How board number `board` finds the others of its plant, on any plane: domain, keys and lease are the plane's.
dds::NetworkSettings network_settings(const config::Plant& plant, std::size_t board);

// `board`: index into plant.boards. The caller sets priority and cores.
mirror::Settings mirror_settings(const config::Plant& plant, const config::PlantCheck& check, std::size_t board);

// What a board exchanges with the others of its plant, to be compared with what another manifest says.
class BoardLinks {
 public:
  BoardLinks() = default;
  explicit BoardLinks(const mirror::Settings& settings);
  // Returns a sentence about the first variable that is exchanged in another way; empty: there is none.
  [[nodiscard]] std::string difference(const mirror::Settings& next) const;

 private:
  std::vector<std::uint64_t> marks_;  // sorted
};

// Marks in `settings` which of the outgoing variables are written by one band only. Variables that one band writes now
// are sent together, also when another schedule has its modules in several. `engine` is borrowed for as long as the
// settings are used.
void name_writers(mirror::Settings& settings, const config::Config& config, const config::CheckResult& check,
                  const scheduler::Engine& engine);

}  // namespace indurop::node
