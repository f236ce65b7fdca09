// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/doctor/interrupts.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/descriptor.h"
#include "tools/cli/doctor/first_line.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

using Counts = std::map<int, std::map<int, std::uint64_t>>;  // by interrupt and core

struct Device {
  std::string name;  // for example "disk vda"
  bool disk = false;
};

std::optional<int> cpu_number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Returns whether a list such as "0-2,4" contains the core; an invalid list contains none.
bool list_holds(const std::string& list, int core) {
  std::istringstream in(list);
  for (std::string range; std::getline(in, range, ',');) {
    const std::size_t dash = range.find('-');
    const auto first = cpu_number_in(std::string_view(range).substr(0, dash));
    const auto last = dash == std::string::npos ? first : cpu_number_in(std::string_view(range).substr(dash + 1));
    if (first && last && *first <= core && core <= *last) {
      return true;
    }
  }
  return false;
}

// Returns the interrupts of the device itself or of its parent: a virtio network card has those of its PCI function.
std::set<int> interrupts_of(const fs::path& device, const fs::path& root) {
  std::error_code error;
  const fs::path top = fs::weakly_canonical(root, error) / "sys/devices";
  std::set<int> numbers;
  fs::path at = fs::canonical(device, error);
  for (; !error && numbers.empty() && at != top && at.has_relative_path(); at = at.parent_path()) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(at / "msi_irqs", none)) {
      if (const auto number = cpu_number_in(entry.path().filename().string())) {
        numbers.insert(*number);
      }
    }
    if (const auto line = cpu_number_in(first_line(at / "irq")); numbers.empty() && line && *line > 0) {
      numbers.insert(*line);
    }
  }
  return numbers;
}

std::map<int, Device> devices_by_interrupt(const fs::path& root) {
  std::map<int, Device> found;
  for (const auto& [folder, kind] : {std::pair("sys/class/net", "network"), std::pair("sys/block", "disk")}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(root / folder, error)) {
      for (const int number : interrupts_of(entry.path() / "device", root)) {
        const bool disk = std::string_view(kind) == "disk";
        found[number] = {fmt::format("{} {}", kind, entry.path().filename().string()), disk};
      }
    }
  }
  return found;
}

// Returns how often each interrupt fired, by number and core. The columns are the cores that are online.
Counts fired(const fs::path& root) {
  Counts counts;
  std::ifstream in(root / "proc/interrupts");
  std::string line;
  std::getline(in, line);
  std::vector<int> cores;
  std::istringstream head(line);
  for (std::string word; head >> word;) {
    cores.push_back(cpu_number_in(std::string_view(word).substr(std::min<std::size_t>(3, word.size()))).value_or(-1));
  }
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string label;
    words >> label;
    const auto number = cpu_number_in(std::string_view(label).substr(0, label.find(':')));
    std::uint64_t count = 0;
    for (std::size_t i = 0; number && i < cores.size() && words >> count; ++i) {
      counts[*number][cores[i]] = count;
    }
  }
  return counts;
}

// Returns the sum over all cores and interrupts of each device, by device name.
std::map<std::string, std::uint64_t> totals(const std::map<int, Device>& devices, const Counts& counts) {
  std::map<std::string, std::uint64_t> sums;
  for (const auto& [number, device] : devices) {
    if (const auto found = counts.find(number); found != counts.end()) {
      for (const auto& [core, count] : found->second) {
        sums[device.name] += count;
      }
    }
  }
  return sums;
}

}  // namespace

// The kernel first checks whether this interrupt may be moved, then parses the value, which is not a mask in this case.
Movable can_move_interrupt(int number) {
  const base::Descriptor out(::open(fmt::format("/proc/irq/{}/smp_affinity", number).c_str(), O_WRONLY | O_CLOEXEC));
  if (out.get() < 0) {
    return Movable::Unknown;
  }
  constexpr std::string_view kNoMask = "x\n";
  const bool refused = ::write(out.get(), kNoMask.data(), kNoMask.size()) < 0;
  return refused && (errno == EIO || errno == EPERM) ? Movable::No : Movable::Yes;
}

Finding examine_interrupts(const std::vector<int>& cores, const fs::path& root,
                           const std::function<Movable(int)>& movable) {
  constexpr std::uint64_t kNoticeable = 100;  // a device has further interrupts, for configuration, that rarely fire
  const auto devices = devices_by_interrupt(root);
  const Counts all = fired(root);
  const auto sums = totals(devices, all);
  std::vector<std::string> found;
  std::vector<int> fixed;
  std::set<int> to_move;  // cores
  bool disk = false;
  for (const auto& [number, counts] : all) {
    const auto device = devices.find(number);
    if (device == devices.end()) {
      continue;
    }
    const std::string taken_by = first_line(root / fmt::format("proc/irq/{}/effective_affinity_list", number));
    for (const int core : cores) {
      const auto count = counts.find(core);
      if (!list_holds(taken_by, core) || count == counts.end() || count->second == 0 ||
          count->second < sums.at(device->second.name) / kNoticeable) {
        continue;
      }
      const Movable can = movable(number);
      found.push_back(fmt::format("{} (interrupt {}, core {}{})", device->second.name, number, core,
                                  can == Movable::No ? ", cannot be moved" : ""));
      disk = disk || device->second.disk;
      can == Movable::No ? fixed.push_back(number) : static_cast<void>(to_move.insert(core));
    }
  }
  if (found.empty()) {
    return {"interrupts", Grade::Ok,
            fmt::format("none of disks or network where ticks run (core {})", fmt::join(cores, ", ")), ""};
  }
  std::vector<std::string> advice;
  for (const int core : to_move) {
    advice.push_back(
        fmt::format("sudo indurop doctor tune --apply --core {} gives those that can be moved to other cores", core));
  }
  if (!fixed.empty()) {
    advice.push_back(fmt::format("the kernel does not let interrupt {} be moved: give the node another core (--core N)",
                                 fmt::join(fixed, ", ")));
  }
  if (disk) {
    advice.emplace_back("what writes to the disk delays ticks: record to memory (indurop record -o /dev/shm/run.mcap)");
  }
  return {"interrupts", Grade::Warn, fmt::format("where ticks run: {}", fmt::join(found, ", ")),
          fmt::format("{}", fmt::join(advice, "; "))};
}

}  // namespace indurop::tools
