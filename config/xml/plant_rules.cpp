// SPDX-License-Identifier: Apache-2.0
#include "config/xml/plant_rules.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "config/xml/config_reader.h"
#include "config/xml/module_file.h"
#include "config/xml/pool_reader.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

bool is_letter_or_digit(char c) noexcept {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

// Checks a host name "a-1.cell.local": labels of letters, digits, '-' and '_'.
bool is_host_name(std::string_view name) {
  constexpr std::size_t kLongest = 253;
  constexpr std::size_t kLongestLabel = 63;
  if (name.size() > kLongest) {
    return false;
  }
  while (true) {
    const std::string_view label = name.substr(0, name.find('.'));
    const bool plain =
        std::all_of(label.begin(), label.end(), [](char c) { return is_letter_or_digit(c) || c == '-' || c == '_'; });
    if (!plain || label.empty() || label.size() > kLongestLabel || label.front() == '-' || label.back() == '-') {
      return false;
    }
    if (label.size() == name.size()) {
      return true;
    }
    name.remove_prefix(label.size() + 1);
  }
}

void check_names(const Plant& plant, base::Diagnostics& report) {
  std::map<std::string, const Board*> named;
  for (const Board& board : plant.boards) {
    if (board.name.empty()) {
      continue;  // reported already
    }
    const auto [first, is_first] = named.try_emplace(in_lower_case(board.name), &board);
    if (is_first) {
      continue;
    }
    const std::string line = std::to_string(first->second->place.line);
    if (first->second->name == board.name) {
      report.error(board.place, "a second board named " + base::in_quotes(board.name) + ", the first is in line " +
                                    line + "; give one of them another name");
    } else {
      report.error(board.place, "the board " + base::in_quotes(board.name) + " and " +
                                    base::in_quotes(first->second->name) + " in line " + line +
                                    " differ only in upper and lower case; give one of them another name");
    }
  }
}

void check_addresses(const Plant& plant, base::Diagnostics& report) {
  std::map<std::string, const Board*> at;
  for (const Board& board : plant.boards) {
    if (board.address.empty()) {
      if (!plant.multicast) {
        report.error(board.place, "the board " + base::in_quotes(board.name) +
                                      " has no address, so with <multicast>off</multicast> no board finds it; write " +
                                      R"(<board name=")" + board.name + R"(" address="10.0.0.1">)");
      }
      continue;
    }
    const auto [first, is_first] = at.try_emplace(in_lower_case(board.address), &board);
    if (!is_first) {
      report.note(board.place, "the boards " + base::in_quotes(first->second->name) + " and " +
                                   base::in_quotes(board.name) +
                                   " have one address; that is right only if both run on one machine");
    }
  }
}

void check_owners(const Plant& plant, base::Diagnostics& report) {
  std::vector<std::string> names;
  for (const Board& board : plant.boards) {
    names.push_back(board.name);
  }
  const std::unordered_set<std::string> known(names.begin(), names.end());
  for (const VariableRule& rule : plant.variables) {
    if (!rule.owner.empty() && !known.contains(rule.owner)) {
      report.error(rule.owner_place, "owner: there is no board " + base::in_quotes(rule.owner) +
                                         (report.full() ? "" : base::suggestion(rule.owner, names)));
    }
  }
}

// Returns whether the name contained ${arch}, which is the architecture of the board.
bool put_architecture(std::string& name, const base::SourcePlace& place, const Board& board,
                      base::Diagnostics& report) {
  static constexpr std::string_view kArch = "${arch}";
  std::size_t at = name.find(kArch);
  if (at == std::string::npos) {
    return false;
  }
  if (board.arch.empty()) {
    report.error(place, "${arch} stands for the architecture of the board, and the board " +
                            base::in_quotes(board.name) + R"( does not say it; write <board name=")" + board.name +
                            R"(" arch="amd64">, or arm64)");
    return false;
  }
  for (; at != std::string::npos; at = name.find(kArch)) {
    name.replace(at, kArch.size(), board.arch);
  }
  return true;
}

}  // namespace

bool is_node_name(std::string_view name) noexcept {
  constexpr std::size_t kLongest = 40;
  return !name.empty() && name.size() <= kLongest &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_letter_or_digit(c) || c == '_' || c == '-'; });
}

std::string address_problem(const std::string& address) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  const bool numbers = address.find_first_not_of("0123456789.") == std::string::npos;
  if (::inet_pton(AF_INET, address.c_str(), bytes.data()) == 1) {
    if (bytes[0] == 0 || bytes[0] >= 224) {
      return base::in_quotes(address) + " is not the address of one machine; write, for example, 10.0.0.1";
    }
    return {};
  }
  if (numbers) {
    return base::in_quotes(address) + " is not an IP address; write four numbers up to 255, for example 10.0.0.1";
  }
  if (address.find(':') != std::string::npos) {
    if (::inet_pton(AF_INET6, address.c_str(), bytes.data()) != 1) {
      return base::in_quotes(address) + " is not an IPv6 address; write, for example, fd00::1 (without port)";
    }
    const bool none = std::all_of(bytes.begin(), bytes.end(), [](unsigned char byte) { return byte == 0; });
    return none || bytes[0] == 0xFF
               ? base::in_quotes(address) + " is not the address of one machine; write, for example, fd00::1"
               : std::string{};
  }
  return is_host_name(address) ? std::string{}
                               : base::in_quotes(address) +
                                     " is neither an IP address nor a host name; write, for example, "
                                     "10.0.0.1 or sensor.cell.local";
}

std::string interface_problem(std::string_view name) {
  constexpr std::size_t kLongest = 15;  // IFNAMSIZ without the NUL
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](char c) { return is_letter_or_digit(c) || c == '_' || c == '-' || c == '.'; });
  if (plain && name.size() <= kLongest && name != "." && name != "..") {
    return {};
  }
  return base::in_quotes(name) +
         " is not the name of a network interface; write one of those `ip link` shows, without what " +
         "follows an '@', for example eth0";
}

std::string arch_problem(const std::string& name) {
  return name == "amd64" || name == "arm64"
             ? std::string{}
             : base::in_quotes(name) + " is not an architecture; write amd64 (x86-64) or arm64 (AArch64)";
}

void add_standbys(Plant& plant, base::Diagnostics& report) {
  std::vector<std::string> names;
  for (const Board& board : plant.boards) {
    names.push_back(board.name);
  }
  std::unordered_map<std::string_view, Board*> by_name;
  for (Board& board : plant.boards) {
    by_name.try_emplace(board.name, &board);
  }
  std::vector<std::pair<Board*, Module>> seconds;
  for (const Board& board : plant.boards) {
    for (const Module& module : board.config.modules) {
      if (module.standby.empty()) {
        continue;
      }
      const auto found = by_name.find(module.standby);
      Board* const other = found == by_name.end() ? nullptr : found->second;
      if (other == nullptr) {
        report.error(module.places.standby, "<standby>: there is no board " + base::in_quotes(module.standby) +
                                                (report.full() ? "" : base::suggestion(module.standby, names)));
      } else if (other == &board) {
        report.error(module.places.standby, "<standby>: " + base::in_quotes(module.name) +
                                                " runs on this board anyway; name another one, that outlives it");
      } else if (std::any_of(other->config.modules.begin(), other->config.modules.end(),
                             [&](const Module& m) { return m.name == module.name; })) {
        report.error(module.places.standby, "<standby>: the board " + base::in_quotes(module.standby) +
                                                " has a module named " + base::in_quotes(module.name) +
                                                " of its own; give one of them another <name>");
      } else {
        seconds.emplace_back(other, module);
      }
    }
  }
  for (auto& [board, module] : seconds) {
    module.is_standby = true;
    module.standby.clear();
    board->config.modules.push_back(std::move(module));
  }
}

void put_architectures(Plant& plant, base::Diagnostics& report) {
  const std::filesystem::path folder = folder_of(plant.file);
  for (Board& board : plant.boards) {
    for (Module& module : board.config.modules) {
      if (put_architecture(module.file_as_written, module.places.file, board, report)) {
        module.file = module_file(folder, module.file_as_written);
      }
    }
    board.types = static_cast<const TypeFiles&>(plant);
    for (std::size_t i = 0; i < board.types.types.size(); ++i) {
      std::string& written = board.types.types_as_written[i];
      if (put_architecture(written, board.types.type_places[i], board, report)) {
        board.types.types[i] = (folder / written).lexically_normal();
      }
    }
  }
}

void check_plant_rules(const Plant& plant, const PlantPlaces& places, base::Diagnostics& report) {
  check_names(plant, report);
  check_addresses(plant, report);
  check_owners(plant, report);
  check_pool_boards(plant, report);
  if (plant.external_domain == plant.domain) {
    const bool given = places.external.line != 0;
    report.error(given ? places.external : places.domain,
                 "the boards' domain and the external one are both " + std::to_string(plant.domain) +
                     (given ? "" : " (<external> is 0 unless given)") +
                     "; other tools must not receive the boards' own traffic: give them different numbers");
  }
}

}  // namespace indurop::config
