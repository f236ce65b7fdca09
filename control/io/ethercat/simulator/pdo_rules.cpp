// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/pdo_rules.h"

#include <algorithm>
#include <limits>

namespace indurop::io::ethercat {

namespace {

using Refusal = std::optional<std::uint32_t>;

constexpr std::uint8_t kPdosOfManager = 16;
constexpr std::uint16_t kFirstMappable = 0x2000;  // objects below describe the communication

bool is_process(const SyncManagerEntry& manager) {
  return manager.use == SyncManagerUse::Outputs || manager.use == SyncManagerUse::Inputs;
}

const std::vector<Pdo>& pdos_of(const Sii& sii, const SyncManagerEntry& manager) {
  return manager.use == SyncManagerUse::Outputs ? sii.outputs : sii.inputs;
}

const Pdo* find_pdo(const std::vector<Pdo>& pdos, std::uint64_t index) {
  const auto found = std::find_if(pdos.begin(), pdos.end(), [index](const Pdo& pdo) { return pdo.index == index; });
  return found == pdos.end() ? nullptr : &*found;
}

void add_contents(const Pdo& pdo, ObjectDictionary& objects) {
  const std::size_t capacity = std::max<std::size_t>(pdo.entries.size(), kPdoCapacity);
  objects.add_number<std::uint8_t>(pdo.index, 0, static_cast<std::uint8_t>(pdo.entries.size()));
  for (std::size_t i = 0; i < capacity; ++i) {
    const PdoEntry entry = i < pdo.entries.size() ? pdo.entries[i] : PdoEntry();
    objects.add_number<std::uint32_t>(
        pdo.index, static_cast<std::uint8_t>(i + 1),
        static_cast<std::uint32_t>(entry.index) << 16U | static_cast<std::uint32_t>(entry.subindex) << 8U | entry.bits);
  }
}

void add_assignment(const std::vector<Pdo>& pdos, std::size_t manager, ObjectDictionary& objects) {
  const auto index = static_cast<std::uint16_t>(kPdoAssignment + manager);
  std::uint8_t count = 0;
  for (const Pdo& pdo : pdos) {
    if (pdo.sync_manager == manager) {
      objects.add_number<std::uint16_t>(index, ++count, pdo.index);
    }
  }
  objects.add_number<std::uint8_t>(index, 0, count);
  while (count < kPdosOfManager) {
    objects.add_number<std::uint16_t>(index, ++count, 0);
  }
}

// What each SyncManager is for: some masters look for mappings of those only that are named here.
void add_manager_types(const Sii& sii, ObjectDictionary& objects) {
  constexpr std::uint16_t kManagerTypes = 0x1C00;
  objects.add_number(kManagerTypes, 0, static_cast<std::uint8_t>(sii.sync_managers.size()), false);
  for (std::size_t i = 0; i < sii.sync_managers.size(); ++i) {
    objects.add_number(kManagerTypes, static_cast<std::uint8_t>(i + 1),
                       static_cast<std::uint8_t>(sii.sync_managers[i].use), false);
  }
}

// PDOs that are exchanged now.
std::vector<std::uint64_t> assigned(const ObjectDictionary& objects, std::uint16_t assignment, std::uint64_t count) {
  std::vector<std::uint64_t> pdos;
  for (std::uint64_t i = 1; i <= count; ++i) {
    pdos.push_back(objects.number(assignment, static_cast<std::uint8_t>(i)));
  }
  return pdos;
}

std::uint64_t bits_of(const ObjectDictionary& objects, std::uint64_t pdo, std::uint64_t count) {
  const auto index = static_cast<std::uint16_t>(pdo);
  std::uint64_t bits = 0;
  for (std::uint64_t i = 1; i <= count; ++i) {
    bits += objects.number(index, static_cast<std::uint8_t>(i)) & 0xFFU;
  }
  return bits;
}

std::uint64_t bits_of(const ObjectDictionary& objects, std::uint64_t pdo) {
  return bits_of(objects, pdo, objects.number(static_cast<std::uint16_t>(pdo), 0));
}

// How many bytes a SyncManager has before the next one begins.
std::size_t room_of(const Sii& sii, std::size_t manager) {
  const std::size_t start = sii.sync_managers[manager].start;
  std::size_t end = std::numeric_limits<std::size_t>::max();
  for (const SyncManagerEntry& other : sii.sync_managers) {
    end = other.start > start ? std::min<std::size_t>(end, other.start) : end;
  }
  return end - start;
}

Refusal judge_length(const Sii& sii, std::size_t manager, std::uint64_t bits) {
  return (bits + 7) / 8 > room_of(sii, manager) ? Refusal(kAbortPdoLength) : std::nullopt;
}

Refusal judge_assignment(const Sii& sii, const ObjectDictionary& objects, std::size_t manager,
                         const ObjectWrite& write) {
  const auto& pdos = pdos_of(sii, sii.sync_managers[manager]);
  if (write.subindex != 0) {
    if (objects.number(write.index, 0) != 0) {
      return kAbortNotEmpty;
    }
    return find_pdo(pdos, write.number) == nullptr ? Refusal(kAbortRange) : std::nullopt;
  }
  if (write.number > kPdosOfManager) {
    return kAbortTooHigh;
  }
  auto all = assigned(objects, write.index, write.number);
  std::uint64_t bits = 0;
  for (const std::uint64_t pdo : all) {
    bits += bits_of(objects, pdo);
  }
  std::sort(all.begin(), all.end());
  if (std::adjacent_find(all.begin(), all.end()) != all.end()) {
    return kAbortIncompatible;
  }
  return judge_length(sii, manager, bits);
}

// What an entry of a PDO names: an object of this slave that can be exchanged, with its length, or a gap.
Refusal judge_entry(const ObjectDictionary& objects, std::uint64_t entry, bool output) {
  const auto index = static_cast<std::uint16_t>(entry >> 16U);
  const auto subindex = static_cast<std::uint8_t>(entry >> 8U);
  std::vector<std::uint8_t> value;
  if (index == 0) {
    return std::nullopt;
  }
  if (const auto missing = objects.read(index, subindex, false, value)) {
    return missing;
  }
  if (index < kFirstMappable || (output && !objects.is_writable(index, subindex))) {
    return kAbortNotMappable;
  }
  const std::uint64_t bits = entry & 0xFFU;
  return bits == 0 || (bits + 7) / 8 != value.size() ? Refusal(kAbortLength) : std::nullopt;
}

// The new count of a PDO's entries: as many as it can take, and if it is assigned, as its SyncManager has room for.
Refusal judge_count(const Sii& sii, const ObjectDictionary& objects, const Pdo& pdo, std::size_t manager,
                    std::uint64_t count) {
  if (count > std::max<std::size_t>(pdo.entries.size(), kPdoCapacity)) {
    return kAbortTooHigh;
  }
  const auto assignment = static_cast<std::uint16_t>(kPdoAssignment + manager);
  std::uint64_t bits = 0;
  for (const std::uint64_t used : assigned(objects, assignment, objects.number(assignment, 0))) {
    bits += used == pdo.index ? bits_of(objects, used, count) : bits_of(objects, used);
  }
  return judge_length(sii, manager, bits);
}

Refusal judge_contents(const Sii& sii, const ObjectDictionary& objects, const Pdo& pdo, std::size_t manager,
                       const ObjectWrite& write) {
  if (write.subindex == 0) {
    return judge_count(sii, objects, pdo, manager, write.number);
  }
  const bool is_output = sii.sync_managers[manager].use == SyncManagerUse::Outputs;
  return objects.number(pdo.index, 0) != 0 ? Refusal(kAbortNotEmpty) : judge_entry(objects, write.number, is_output);
}

}  // namespace

void add_pdo_objects(const Sii& sii, ObjectDictionary& objects) {
  if ((sii.protocols & kProtocolCoe) == 0) {
    return;
  }
  add_manager_types(sii, objects);
  for (std::size_t i = 0; i < sii.sync_managers.size(); ++i) {
    const SyncManagerEntry& manager = sii.sync_managers[i];
    const auto& pdos = pdos_of(sii, manager);
    if (!is_process(manager) || pdos.empty()) {
      continue;
    }
    add_assignment(pdos, i, objects);
    for (const Pdo& pdo : pdos) {
      add_contents(pdo, objects);
    }
  }
}

std::optional<std::uint32_t> judge_mapping(const Sii& sii, const ObjectDictionary& objects, AlState state,
                                           const ObjectWrite& write) {
  const auto refused = [state](bool is_fixed) -> Refusal {
    return is_fixed ? Refusal(kAbortReadOnly) : state != AlState::PreOp ? Refusal(kAbortState) : std::nullopt;
  };
  for (std::size_t i = 0; i < sii.sync_managers.size(); ++i) {
    const SyncManagerEntry& manager = sii.sync_managers[i];
    const auto assignment = static_cast<std::uint16_t>(kPdoAssignment + i);
    if (!is_process(manager) || pdos_of(sii, manager).empty()) {
      continue;
    }
    if (write.index == assignment) {
      const auto no = refused((sii.coe_details & kCoePdoAssign) == 0);
      return no ? no : judge_assignment(sii, objects, i, write);
    }
    if (const Pdo* const pdo = find_pdo(pdos_of(sii, manager), write.index)) {
      const auto no = refused((sii.coe_details & kCoePdoConfiguration) == 0 || (pdo->flags & kPdoFixed) != 0);
      return no ? no : judge_contents(sii, objects, *pdo, i, write);
    }
  }
  return std::nullopt;
}

}  // namespace indurop::io::ethercat
