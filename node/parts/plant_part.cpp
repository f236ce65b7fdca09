// SPDX-License-Identifier: Apache-2.0
#include "node/parts/plant_part.h"

#include <algorithm>

#include "core/keys/participant_keys.h"

namespace indurop::node {

namespace {

constexpr std::int64_t kTimeoutNs = 1'000'000'000;

const scheduler::Band* band_of(const std::string& module, const config::Config& config,
                               const scheduler::Engine& engine) {
  const auto found = std::find_if(config.modules.begin(), config.modules.end(),
                                  [&](const config::Module& known) { return known.name == module; });
  return found == config.modules.end() ? nullptr
                                       : engine.band_of(static_cast<std::uint32_t>(found - config.modules.begin()));
}

// Returns null if no module writes the variable, several bands do, or a module that is in no band.
const scheduler::Band* writer_of(const std::string& variable, const config::Config& config,
                                 const config::CheckResult& check, const scheduler::Engine& engine) {
  const auto use = std::find_if(check.uses.begin(), check.uses.end(),
                                [&](const config::VariableUse& known) { return known.name == variable; });
  if (use == check.uses.end() || use->writers.empty()) {
    return nullptr;
  }
  const scheduler::Band* const band = band_of(use->writers.front(), config, engine);
  const bool alone = std::all_of(use->writers.begin(), use->writers.end(),
                                 [&](const std::string& module) { return band_of(module, config, engine) == band; });
  return alone ? band : nullptr;
}

}  // namespace

dds::Security board_security(const config::Plant& plant, const std::string& board) {
  const std::filesystem::path folder = config::keys_folder(plant, board);
  if (folder.empty()) {
    return {};
  }
  const keys::ParticipantKeys keys(folder);
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

void name_writers(mirror::Settings& settings, const config::Config& config, const config::CheckResult& check,
                  const scheduler::Engine& engine) {
  std::vector<const scheduler::Band*> bands;
  for (mirror::Outgoing& out : settings.outgoing) {
    const scheduler::Band* const band = writer_of(out.variable, config, check, engine);
    if (band == nullptr) {
      continue;
    }
    const auto known = std::find(bands.begin(), bands.end(), band);
    out.writers = static_cast<int>(known - bands.begin());
    if (known == bands.end()) {
      bands.push_back(band);
      // A module in a process of its own does not wake the mirror when it is done.
      settings.writers.push_back({[band] { return band->activity(); },
                                  band->plan().kind != scheduler::BandKind::Process,
                                  std::max(kTimeoutNs, 2 * band->plan().period_ns)});
    }
  }
}

}  // namespace indurop::node
