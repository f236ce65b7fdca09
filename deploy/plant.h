// SPDX-License-Identifier: Apache-2.0
// The deployment manifest as data: which boards a plant has, which modules run on which, how variables travel between
// them. Each board's modules are a Config like that of a module.xml.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deploy/check.h"
#include "deploy/config.h"
#include "deploy/reader.h"

namespace indurop::deploy {

struct Board {
  std::string name;            // [A-Za-z0-9_-]{1,40}; the node of the board has the same name
  std::string address;         // IP address or host name for <multicast>off</multicast>; empty: found by multicast
  std::string interface_name;  // network interface the plant is reached through; empty: DDS chooses
  Config config;
  Place place;
};

struct Plant : TypeFiles {
  std::filesystem::path file;
  std::string name;
  int domain = kDefaultDomain;                  // DDS domain between the boards, 0..230
  std::optional<int> external_domain = 0;       // typed topics for other tools; empty: none
  bool external_ros2 = false;                   // its topics have the names and types of ROS 2
  bool multicast = true;                        // false: boards find each other by <board address="">
  std::filesystem::path security;               // folder of its keys (docs/security.md); empty: open to anyone
  Place security_place;                         // of the folder, else of <plant>
  Nanos lease{std::chrono::milliseconds(500)};  // a board not heard for so long is gone
  std::vector<Board> boards;                    // in file order
  std::vector<VariableRule> variables;
  static constexpr int kDefaultDomain = 77;
};

struct ReadPlant {
  Plant plant;                          // meaningful only if ok
  std::vector<Diagnostic> diagnostics;  // of the file, in order of place
  [[nodiscard]] bool ok() const noexcept;
};

// True if the root element of the file is <plant>; false for everything else, unreadable files included.
bool is_plant_file(const std::filesystem::path& file);
// Limits and errors as read_config(). Not real-time safe.
ReadPlant read_plant(const std::filesystem::path& file);
ReadPlant read_plant_text(std::string_view xml, const std::filesystem::path& pretend_file);

// One variable that leaves its board.
struct Route {
  std::string variable;               // full name
  std::size_t owner = 0;              // into Plant::boards
  std::vector<std::size_t> standbys;  // boards whose value counts when the owner's does not come
  std::vector<std::size_t> readers;   // boards that need it, none of those above
  Nanos every{};
  bool best_effort = false;
  Nanos oldest{};  // age of the value at most when a periodic module reads it, kNetworkHop included; 0: not known
};
// What the check counts for one way from a board's store to another's. Lost packets make it longer.
inline constexpr Nanos kNetworkHop{std::chrono::milliseconds(1)};

struct PlantCheck {
  std::vector<Diagnostic> diagnostics;  // of all boards and of the plant
  std::vector<CheckResult> boards;      // one per Plant::boards
  std::vector<Route> routes;            // by variable name
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

}  // namespace indurop::deploy
