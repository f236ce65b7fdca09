// SPDX-License-Identifier: Apache-2.0
#include "network/dds/network_options.h"

#include <fmt/format.h>

namespace indurop::dds {

void add_network_options(base::Options& line, NetworkSettings& network, const std::string& whose, bool* implied,
                         const std::string& implied_option) {
  const std::string too = implied == nullptr ? "" : "; implies " + implied_option;
  const auto add_implied = [implied](base::Option option) {
    if (implied != nullptr) {
      option.implies(*implied);
    }
    return option;
  };
  add_implied(line.add("--domain", "N", network.domain,
                       fmt::format("DDS domain of {} (default: {}){}", whose, network.domain, too)))
      .range(0, 230);
  add_implied(line.add("--interface", "IF", network.interface_name, "Network interface (default: the only one)" + too));
  add_implied(
      line.flag("--one-host", network.one_host, "All boards of the plant run on this host: use only loopback" + too));
}

}  // namespace indurop::dds
