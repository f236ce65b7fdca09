// SPDX-License-Identifier: Apache-2.0
#include "node/plant_part.h"

#include <algorithm>

#include "deploy/plant_keys.h"

namespace indurop::node {

namespace {

constexpr std::int64_t kPatienceNs = 1'000'000'000;

mirror::Security security_of(const std::filesystem::path& folder) {
  if (folder.empty()) {
    return {};
  }
  const deploy::ParticipantKeys keys(folder);
  return {keys.authority.string(),  keys.certificate.string(), keys.key.string(),
          keys.governance.string(), keys.permissions.string(), keys.revoked.string()};
}

const scheduler::Band* band_of(const std::string& module, const deploy::Config& config,
                               const scheduler::Engine& engine) {
  const auto found = std::find_if(config.modules.begin(), config.modules.end(),
                                  [&](const deploy::Module& known) { return known.name == module; });
  return found == config.modules.end() ? nullptr
                                       : engine.band_of(static_cast<std::uint32_t>(found - config.modules.begin()));
}

// Null if nobody writes the variable, several bands do, or something that is in no band.
const scheduler::Band* writer_of(const std::string& variable, const deploy::Config& config,
                                 const deploy::CheckResult& check, const scheduler::Engine& engine) {
  const auto use = std::find_if(check.uses.begin(), check.uses.end(),
                                [&](const deploy::VariableUse& known) { return known.name == variable; });
  if (use == check.uses.end() || use->writers.empty()) {
    return nullptr;
  }
  const scheduler::Band* const band = band_of(use->writers.front(), config, engine);
  const bool alone = std::all_of(use->writers.begin(), use->writers.end(),
                                 [&](const std::string& module) { return band_of(module, config, engine) == band; });
  return alone ? band : nullptr;
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

void name_writers(mirror::Settings& settings, const deploy::Config& config, const deploy::CheckResult& check,
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
      // Who is a process of its own wakes nobody here when it is done.
      settings.writers.push_back({[band] { return band->activity(); },
                                  band->plan().kind != scheduler::BandKind::Process,
                                  std::max(kPatienceNs, 2 * band->plan().period_ns)});
    }
  }
}

}  // namespace indurop::node
