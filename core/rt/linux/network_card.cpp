// SPDX-License-Identifier: Apache-2.0
// By what drivers answer to the questions of ethtool(8).
#include "core/rt/network_card.h"

#include <linux/ethtool.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace indurop::rt {
namespace {

// Asks the driver of the interface. Returns false if it does not know the question.
template <class Question>
bool ask_driver(const std::string& name, Question& question) {
  ifreq request{};
  if (name.size() >= sizeof request.ifr_name) {
    return false;
  }
  std::copy(name.begin(), name.end(), std::begin(request.ifr_name));
  request.ifr_data = reinterpret_cast<char*>(&question);
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) {
    return false;
  }
  const bool is_answered = ::ioctl(socket, SIOCETHTOOL, &request) == 0;
  ::close(socket);
  return is_answered;
}

std::uint32_t value_of(const std::string& name, std::uint32_t command) {
  ethtool_value value{};
  value.cmd = command;
  return ask_driver(name, value) ? value.data : 0;
}

}  // namespace

CardSettings card_settings(const std::string& interface) {
  CardSettings settings;
  ethtool_coalesce coalesce{};
  coalesce.cmd = ETHTOOL_GCOALESCE;
  if (ask_driver(interface, coalesce)) {
    settings.receive_wait_us = coalesce.rx_coalesce_usecs;
    settings.send_wait_us = coalesce.tx_coalesce_usecs;
  }
  settings.gathers_frames =
      value_of(interface, ETHTOOL_GGRO) != 0 || (value_of(interface, ETHTOOL_GFLAGS) & ETH_FLAG_LRO) != 0;
  return settings;
}

}  // namespace indurop::rt
