// SPDX-License-Identifier: Apache-2.0
// All checks that are possible before a plant runs: those of check.h for each board, and those between boards.

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

// A variable that is sent from its board to others.
struct Route {
  std::string variable;               // full name
  std::size_t owner = 0;              // index into Plant::boards
  std::vector<std::size_t> standbys;  // boards whose value is used when the owner's does not arrive
  std::vector<std::size_t> readers;   // boards that need the variable, except owner and standbys
  base::Nanos every{};
  bool best_effort = false;
  base::Nanos oldest{};  // maximum age when a periodic module reads it, kNetworkHop included; 0: not known
};
// Time that the check assumes for one transfer from a board's store to another's. Lost packets make it longer.
inline constexpr base::Nanos kNetworkHop{std::chrono::milliseconds(1)};

struct PlantCheck {
  std::vector<base::Diagnostic> diagnostics;  // of all boards and of the plant
  std::vector<CheckResult> boards;            // one per Plant::boards
  std::vector<Route> routes;                  // by variable name
  // Index into Plant::boards of the owner of every variable of the plant. The owner of a variable without a writer is
  // the first board that has it.
  std::map<std::string, std::size_t> owners;
  std::map<std::string, std::vector<std::size_t>> standbys;  // boards that also compute the variable, if any
  [[nodiscard]] bool ok() const noexcept;
};

// Returns the folder with the keys of a board: in the plant's folder, or, on a board to which they were copied, in
// $INDUROP_KEYS_DIR/PLANT/BOARD, normally below /etc/indurop/keys. Empty for an open plant.
std::filesystem::path keys_folder(const Plant& plant, const std::string& board);

// Checks every board, then the rules between them: one owner per variable, a writer for every reader, equal types, data
// age across boards, pools that are sent between them. Replaces names in Plant::variables and Plant::pools by full
// names. A board's schema is extended by the variables that its modules name in <access> and that only modules of other
// boards declare.
PlantCheck check_plant(Plant& plant, const CheckOptions& options);

}  // namespace indurop::config
