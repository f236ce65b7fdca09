// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/doctor/bus_interface.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <net/if.h>

#include <algorithm>
#include <charconv>

#include "tools/cli/doctor/first_line.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

int number_in(const std::string& text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Those of a card with several queues are in a folder; those of others have a file.
std::vector<int> interrupts_of(const fs::path& device) {
  std::vector<int> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(device / "msi_irqs", error)) {
    found.push_back(number_in(entry.path().filename().string()));
  }
  if (const std::string line = first_line(device / "irq"); found.empty() && !line.empty() && line != "0") {
    found.push_back(number_in(line));
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

InterfaceFacts facts_of_interface(const std::string& name, const fs::path& root) {
  const fs::path folder = root / "sys/class/net" / name;
  InterfaceFacts facts;
  std::error_code error;
  facts.is_there = name.find('/') == std::string::npos && fs::exists(folder, error);
  if (!facts.is_there) {
    return facts;
  }
  unsigned flags = 0;
  const std::string text = first_line(folder / "flags");
  if (text.starts_with("0x")) {
    std::from_chars(text.data() + 2, text.data() + text.size(), flags, 16);
  }
  facts.is_up = (flags & IFF_UP) != 0;
  facts.has_carrier = first_line(folder / "carrier") == "1";
  facts.speaks_ipv6 = first_line(root / "proc/sys/net/ipv6/conf" / name / "disable_ipv6") == "0";
  facts.driver = fs::read_symlink(folder / "device/driver", error).filename();
  facts.interrupts = interrupts_of(folder / "device");
  facts.card = rt::card_settings(name);
  return facts;
}

std::vector<Finding> examine_interface(const std::string& name, const InterfaceFacts& facts, bool preempt_rt) {
  std::vector<Finding> findings;
  const auto find = [&](Grade grade, const std::string& found, const std::string& advice) {
    findings.push_back({"bus-interface", grade, fmt::format("{}: {}", name, found), advice});
  };
  if (!facts.is_there) {
    find(Grade::Fail, "there is no such network interface", "`ip link` lists those of this machine");
    return findings;
  }
  if (!facts.is_up) {
    find(Grade::Fail, "it is switched off", fmt::format("ip link set {} up", name));
  } else if (!facts.has_carrier) {
    find(Grade::Warn, "no link", "check the cable, and the power of the first slave");
  }
  if (facts.speaks_ipv6) {
    find(Grade::Warn, "the kernel sends frames of its own there (IPv6)",
         fmt::format("sysctl net.ipv6.conf.{}.disable_ipv6=1, and give it no addresses", name));
  }
  if (facts.card.receive_wait_us.value_or(0) > 0 || facts.card.send_wait_us.value_or(0) > 0) {
    find(Grade::Warn,
         fmt::format("the card holds back interrupts for {} us (receive) and {} us (send)",
                     facts.card.receive_wait_us.value_or(0), facts.card.send_wait_us.value_or(0)),
         fmt::format("a frame comes back so much later: ethtool -C {} adaptive-rx off rx-usecs 0 tx-usecs 0", name));
  }
  if (facts.card.gathers_frames && !facts.driver.empty()) {
    find(Grade::Warn, "received frames are gathered (GRO, LRO)",
         fmt::format("each frame is one to wait for: ethtool -K {} gro off lro off", name));
  }
  if (preempt_rt && !facts.interrupts.empty()) {
    find(Grade::Ok, fmt::format("interrupts {}, handled by threads of the kernel", fmt::join(facts.interrupts, ", ")),
         fmt::format("give these threads a priority above other work, below the node's: "
                     "chrt -f -p 60 $(pgrep irq/{}-)",
                     facts.interrupts.front()));
  }
  if (findings.empty()) {
    find(Grade::Ok, facts.driver.empty() ? "no hardware, nothing to set" : fmt::format("fit ({})", facts.driver), "");
  }
  return findings;
}

}  // namespace indurop::tools
