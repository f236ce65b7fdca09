// SPDX-License-Identifier: Apache-2.0
#include "node/plant_part.h"

#include <algorithm>

#include "deploy/plant_keys.h"

namespace indurop::node {

namespace {

mirror::Security security_of(const std::filesystem::path& folder) {
  if (folder.empty()) {
    return {};
  }
  const deploy::ParticipantKeys keys(folder);
  return {keys.authority.string(),  keys.certificate.string(), keys.key.string(),
          keys.governance.string(), keys.permissions.string(), keys.revoked.string()};
}

}  // namespace

mirror::Settings mirror_settings(const deploy::Plant& plant, const deploy::PlantCheck& check, std::size_t board) {
  const deploy::Board& own = plant.boards[board];
  mirror::Settings settings;
  settings.plant = plant.name;
  settings.board = own.name;
  settings.domain = plant.domain;
  settings.interface_name = own.interface_name;
  settings.address = own.address;
  settings.multicast = plant.multicast;
  settings.security = security_of(deploy::keys_folder(plant, own.name));
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
