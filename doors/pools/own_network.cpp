// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/own_network.h"

#include <fmt/format.h>

#include <chrono>

#include "config/check/check_plant.h"
#include "config/xml/plant_reader.h"
#include "core/keys/participant_keys.h"
#include "deploy/link/link_keys.h"
#include "doors/pools/part.h"
#include "network/dds/security.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/run_view.h"
#include "tools/client/values/peer_address.h"

namespace indurop::pool_door {
namespace {

constexpr std::chrono::seconds kLease{2};
// One part: sockets have 208 kB by default, and of a burst of more, much is lost and repeated (ADR 54).
constexpr std::size_t kInFlight = kPartBytes;
constexpr std::chrono::seconds kResolve{3};

// Returns the keys of the node's board; none in an open plant and for a node of its own.
Result<dds::Security, tools::Failure> keys_of_board(const std::string& node) {
  const auto mirror = tools::view_mirror(node);
  const auto run = tools::RunView::open(node);
  const std::string file = run ? tools::fixed_text(run->block().config_file) : std::string();
  if (!mirror && !config::is_plant_file(file)) {
    return dds::Security{};
  }
  const config::ReadPlant read = config::read_plant(file);
  if (!read.ok()) {
    return tools::Failure{
        kUsage, fmt::format("cannot find out whether the plant of node '{}' has keys, because its manifest '{}' cannot "
                            "be read: say --keys DIR, or make the file readable",
                            node, file)};
  }
  const std::filesystem::path folder = config::keys_folder(read.plant, mirror ? mirror->board : node);
  return folder.empty() ? dds::Security{} : deploy::security_of(keys::ParticipantKeys(folder));
}

}  // namespace

Result<dds::NetworkSettings, tools::Failure> own_network(const DoorOptions& options, const std::string& node) {
  dds::NetworkSettings network = options.network;
  if (!network.security.on()) {
    auto keys = keys_of_board(node);
    if (!keys) {
      return std::move(keys).error();
    }
    network.security = std::move(*keys);
  }
  if (network.security.on()) {
    if (const auto usable = dds::security_usable(network.security, dds::security_plugins()); !usable) {
      return tools::Failure{
          kUsage, fmt::format("{} (the plant of node '{}' has keys; others: --keys DIR)", usable.error().text, node)};
    }
  }
  auto peers = tools::peer_addresses(network.peers, rt::MonoClock::now() + kResolve);
  if (!peers) {
    return std::move(peers).error();
  }
  network.peers = std::move(*peers);
  network.peers.emplace_back("127.0.0.1");  // programs of this machine
  if (network.one_host) {
    network.interface_name = "lo";  // tools of others are found by multicast on it too
    network.one_host = false;
  }
  network.known_ports = true;
  network.lease_ns = std::chrono::nanoseconds(kLease).count();
  network.in_flight = kInFlight;
  return network;
}

}  // namespace indurop::pool_door
