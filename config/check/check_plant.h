// SPDX-License-Identifier: Apache-2.0
// What can be known to be wrong with a plant before it runs: every board as check.h has it, and what holds between
// them.

#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/model/plant.h"

namespace indurop::config {

// One variable that leaves its board.
struct Route {
  std::string variable;               // full name
  std::size_t owner = 0;              // into Plant::boards
  std::vector<std::size_t> standbys;  // boards whose value counts when the owner's does not come
  std::vector<std::size_t> readers;   // boards that need it, none of those above
  base::Nanos every{};
  bool best_effort = false;
  base::Nanos oldest{};  // age of the value at most when a periodic module reads it, kNetworkHop included; 0: not known
};
// What the check counts for one way from a board's store to another's. Lost packets make it longer.
inline constexpr base::Nanos kNetworkHop{std::chrono::milliseconds(1)};

struct PlantCheck {
  std::vector<base::Diagnostic> diagnostics;  // of all boards and of the plant
  std::vector<CheckResult> boards;            // one per Plant::boards
  std::vector<Route> routes;                  // by variable name
  // Board, into Plant::boards, whose value counts: of every variable of the plant; of those nobody writes the first
  // board that has it.
  std::map<std::string, std::size_t> owners;
  std::map<std::string, std::vector<std::size_t>> standbys;  // boards that compute the variable too, if any
  [[nodiscard]] bool ok() const noexcept;
};

// Where the keys of a board are: in the plant's folder, or, on a board to which they were copied, in
// $INDUROP_KEYS_DIR/PLANT/BOARD, normally below /etc/indurop/keys. Empty for an open plant.
std::filesystem::path keys_folder(const Plant& plant, const std::string& board);

// Checks every board, then what holds between them: one owner per variable, a writer for every reader, equal types,
// data age across boards. Names in Plant::variables become full names. A board's schema gains the variables its modules
// name in <access> that only modules of other boards declare.
PlantCheck check_plant(Plant& plant, const CheckOptions& options);

}  // namespace indurop::config
