// SPDX-License-Identifier: Apache-2.0
// The deployment manifest as data: the boards of a plant, the modules of each board, and how variables travel between
// them. The modules of a board are a Config like that of a module.xml.

#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "config/model/simulated_network.h"

namespace indurop::config {

struct Board {
  std::string name;            // [A-Za-z0-9_-]{1,40}; the node of the board has the same name
  std::string address;         // IP address or host name for <multicast>off</multicast>; empty: found by multicast
  std::string interface_name;  // network interface that connects the plant; empty: DDS chooses
  std::string arch;            // of its processor, as Debian calls it: amd64, arm64; empty: not declared
  TypeFiles types;             // those of the plant, for its architecture
  Config config;
  base::SourcePlace place;
};

// A pool of one board whose chunks are also published in the pool of the same name on other boards.
struct PoolRoute {
  std::string name;  // full name after check_plant()
  std::string from;
  std::vector<std::string> to;
  base::Nanos every{};  // minimum time between two chunks; 0: all that the network takes
  base::SourcePlace place;
  base::SourcePlace from_place;
  std::vector<base::SourcePlace> to_places;  // one per `to`
};

struct Plant : TypeFiles {
  std::filesystem::path file;
  std::string name;
  int domain = kDefaultDomain;                        // DDS domain between the boards, 0..230
  std::optional<int> external_domain = 0;             // typed topics for other tools; empty: none
  bool external_secure = false;                       // only participants with keys can join it
  bool external_ros2 = false;                         // its topics have the names and types of ROS 2
  bool multicast = true;                              // false: boards find each other by <board address="">
  std::filesystem::path security;                     // folder of its keys (docs/security.md); empty: open to all
  base::SourcePlace security_place;                   // of the folder, else of <plant>
  bool sources = true;                                // its sources travel with a deployment
  std::filesystem::path sources_folder;               // empty: the manifest's folder, if it has a CMakeLists.txt
  base::Nanos lease{std::chrono::milliseconds(500)};  // a board that was silent for this time is considered lost
  SimulatedNetwork network;                           // between its boards in a simulation
  std::vector<Board> boards;                          // in file order
  std::vector<VariableRule> variables;
  std::vector<PoolRoute> pools;
  static constexpr int kDefaultDomain = 77;
};

}  // namespace indurop::config
