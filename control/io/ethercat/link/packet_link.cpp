// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/link/packet_link.h"

#include <fmt/format.h>
#include <net/if.h>

#include <system_error>

namespace indurop::io::ethercat {

namespace {

constexpr std::uint16_t kFramesOfEtherCat = 0x88A4;

std::string names_of_interfaces() {
  std::string names;
  struct if_nameindex* const all = if_nameindex();
  for (const auto* one = all; one != nullptr && one->if_index != 0; ++one) {
    names += names.empty() ? "" : ", ";
    names += one->if_name;
  }
  if (all != nullptr) {
    if_freenameindex(all);
  }
  return names;
}

std::string text_of(const rt::PacketProblem& problem, const std::string& interface) {
  switch (problem.kind) {
    case rt::PacketProblem::Kind::NoRight:
      return "no right to open raw sockets; give the program CAP_NET_RAW, or start it as root";
    case rt::PacketProblem::Kind::NoInterface:
      return fmt::format("there is no network interface '{}'; there are: {}", interface, names_of_interfaces());
    case rt::PacketProblem::Kind::SwitchedOff:
      return fmt::format("interface {} is switched off; run: ip link set {} up", interface, interface);
    case rt::PacketProblem::Kind::System:
      break;
  }
  return fmt::format("interface {} cannot be used: {}", interface, std::system_category().message(problem.sys_errno));
}

}  // namespace

Result<std::unique_ptr<PacketLink>, std::string> PacketLink::open(const std::string& interface) {
  auto socket = rt::PacketSocket::open(interface, kFramesOfEtherCat);
  if (!socket) {
    return text_of(socket.error(), interface);
  }
  return std::unique_ptr<PacketLink>(new PacketLink(std::move(*socket)));  // NOLINT: the constructor is private
}

}  // namespace indurop::io::ethercat
