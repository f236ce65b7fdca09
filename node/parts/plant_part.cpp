// SPDX-License-Identifier: Apache-2.0
#include "node/parts/plant_part.h"

#include <indurop/detail/abi.h>

#include <fmt/format.h>

#include <algorithm>

#include "core/keys/participant_keys.h"

namespace indurop::node {

namespace {

constexpr std::int64_t kTimeoutNs = 1'000'000'000;

std::uint32_t index_of(const std::string& module, const config::Config& config) {
  return static_cast<std::uint32_t>(
      std::find_if(config.modules.begin(), config.modules.end(),
                   [&module](const config::Module& known) { return known.name == module; }) -
      config.modules.begin());
}

// The only band that writes a variable, and which of its modules do.
struct Writing {
  const scheduler::Band* band = nullptr;  // null: no module, several bands, or a module that is in no band
  std::vector<std::uint32_t> modules;
};

Writing writing_of(const std::string& variable, const config::Config& config, const config::CheckResult& check,
                   const scheduler::Engine& engine) {
  Writing writing;
  const auto use = std::find_if(check.uses.begin(), check.uses.end(),
                                [&](const config::VariableUse& known) { return known.name == variable; });
  if (use == check.uses.end() || use->writers.empty()) {
    return writing;
  }
  for (const std::string& name : use->writers) {
    writing.modules.push_back(index_of(name, config));
  }
  const scheduler::Band* const band = engine.band_of(writing.modules.front());
  const bool alone = std::all_of(writing.modules.begin(), writing.modules.end(),
                                 [&](std::uint32_t module) { return engine.band_of(module) == band; });
  writing.band = alone ? band : nullptr;
  return writing;
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

namespace {

std::uint64_t mark_of(const mirror::Outgoing& out) {
  const std::string text = fmt::format("> {} {} {}", out.variable, out.every_ns, out.best_effort);
  return abi::fnv1a64(text.data(), text.size());
}

std::uint64_t mark_of(const mirror::Incoming& in) {
  const std::string text = fmt::format("< {} {}", in.variable, in.owner);
  return abi::fnv1a64(text.data(), text.size());
}

}  // namespace

BoardLinks::BoardLinks(const mirror::Settings& settings) {
  for (const mirror::Outgoing& out : settings.outgoing) {
    marks_.push_back(mark_of(out));
  }
  for (const mirror::Incoming& in : settings.incoming) {
    marks_.push_back(mark_of(in));
  }
  std::sort(marks_.begin(), marks_.end());
}

std::string BoardLinks::difference(const mirror::Settings& next) const {
  const auto known = [this](const auto& one) { return std::binary_search(marks_.begin(), marks_.end(), mark_of(one)); };
  for (const mirror::Outgoing& out : next.outgoing) {
    if (!known(out)) {
      return fmt::format("variable {} would be sent to other boards in another way", out.variable);
    }
  }
  for (const mirror::Incoming& in : next.incoming) {
    if (!known(in)) {
      return fmt::format("variable {} would be read from board {}", in.variable, in.owner);
    }
  }
  return next.outgoing.size() + next.incoming.size() == marks_.size()
             ? ""
             : "fewer variables would be exchanged with other boards";
}

void name_writers(mirror::Settings& settings, const config::Config& config, const config::CheckResult& check,
                  const scheduler::Engine& engine) {
  struct Group {
    const scheduler::Band* band;
    std::vector<std::uint32_t> modules;  // sorted
  };
  std::vector<Group> groups;
  for (mirror::Outgoing& out : settings.outgoing) {
    const Writing writing = writing_of(out.variable, config, check, engine);
    if (writing.band == nullptr) {
      continue;
    }
    const auto known = std::find_if(groups.begin(), groups.end(),
                                    [&writing](const Group& group) { return group.band == writing.band; });
    out.writers = static_cast<int>(known - groups.begin());
    Group& group = known == groups.end() ? groups.emplace_back(Group{writing.band, {}}) : *known;
    group.modules.insert(group.modules.end(), writing.modules.begin(), writing.modules.end());
    std::sort(group.modules.begin(), group.modules.end());
    group.modules.erase(std::unique(group.modules.begin(), group.modules.end()), group.modules.end());
  }
  for (const Group& group : groups) {
    // A module in a process of its own does not wake the mirror when it is done.
    settings.writers.push_back({[&engine, modules = group.modules] { return engine.activity_of(modules); },
                                group.band->plan().kind != scheduler::BandKind::Process,
                                std::max(kTimeoutNs, 2 * group.band->plan().period_ns)});
  }
}

}  // namespace indurop::node
