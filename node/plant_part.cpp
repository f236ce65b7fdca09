// SPDX-License-Identifier: Apache-2.0
#include "node/plant_part.h"

#include <algorithm>

namespace indurop::node {

mirror::Settings mirror_settings(const deploy::Plant& plant, const deploy::PlantCheck& check, std::size_t board) {
  const deploy::Board& own = plant.boards[board];
  mirror::Settings settings;
  settings.plant = plant.name;
  settings.board = own.name;
  settings.domain = plant.domain;
  settings.interface_name = own.interface_name;
  settings.address = own.address;
  settings.multicast = plant.multicast;
  settings.lease_ns = plant.lease.count();
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    if (i != board) {
      settings.boards.push_back(plant.boards[i].name);
      if (!plant.boards[i].address.empty()) {
        settings.peers.push_back(plant.boards[i].address);
      }
    }
  }
  for (const deploy::Route& route : check.routes) {
    const bool stands_by = std::find(route.standbys.begin(), route.standbys.end(), board) != route.standbys.end();
    if (route.owner == board || stands_by) {
      settings.outgoing.push_back({route.variable, route.every.count(), route.best_effort});
    } else if (std::find(route.readers.begin(), route.readers.end(), board) != route.readers.end()) {
      settings.incoming.push_back({route.variable, plant.boards[route.owner].name});
      for (const std::size_t other : route.standbys) {
        settings.incoming.push_back({route.variable, plant.boards[other].name});
      }
    }
  }
  return settings;
}

}  // namespace indurop::node
