// SPDX-License-Identifier: Apache-2.0
#include "node/parts/plant_part.h"

#include <algorithm>

#include "core/keys/participant_keys.h"
#include "core/keys/trust_list.h"
#include "store/vars/retain.h"

namespace indurop::node {

dds::Security board_security(const config::Plant& plant, const std::string& board) {
  const std::filesystem::path folder = config::keys_folder(plant, board);
  if (folder.empty()) {
    return {};
  }
  keys::ParticipantKeys keys(folder);
  keys.revoked =
      keys::ReceivedTrust(keys, keys::received_trust(vars::state_directory(board), plant.name)).current().revoked;
  return {keys.authority.string(),  keys.certificate.string(), keys.key.string(),
          keys.governance.string(), keys.permissions.string(), keys.revoked.string()};
}

dds::NetworkSettings network_settings(const config::Plant& plant, std::size_t board) {
  const config::Board& own = plant.boards[board];
  dds::NetworkSettings settings;
  settings.board = own.name;
  settings.interface_name = own.interface_name;
  settings.address = own.address;
  settings.multicast = plant.multicast;
  settings.others = plant.boards.size() - 1;
  for (const config::Board& other : plant.boards) {
    if (&other != &own && !other.address.empty()) {
      settings.peers.push_back(other.address);
    }
  }
  return settings;
}

mirror::Settings mirror_settings(const config::Plant& plant, const config::PlantCheck& check, std::size_t board) {
  const config::Board& own = plant.boards[board];
  mirror::Settings settings;
  settings.plant = plant.name;
  settings.network = network_settings(plant, board);
  settings.network.domain = plant.domain;
  settings.network.security = board_security(plant, own.name);
  settings.network.lease_ns = plant.lease.count();
  for (const config::Board& other : plant.boards) {
    if (&other != &own) {
      settings.boards.push_back(other.name);
    }
  }
  for (const config::Route& route : check.routes) {
    const bool stands_by = std::find(route.standbys.begin(), route.standbys.end(), board) != route.standbys.end();
    if (route.owner == board || stands_by) {
      settings.routes.outgoing.push_back({route.variable, route.every.count(), route.best_effort});
    } else if (std::find(route.readers.begin(), route.readers.end(), board) != route.readers.end()) {
      settings.routes.incoming.push_back({route.variable, plant.boards[route.owner].name});
      for (const std::size_t other : route.standbys) {
        settings.routes.incoming.push_back({route.variable, plant.boards[other].name});
      }
    }
  }
  return settings;
}

}  // namespace indurop::node
