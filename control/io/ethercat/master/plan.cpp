// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/plan.h"

#include <algorithm>

#include "control/io/ethercat/coe.h"
#include "control/io/ethercat/master/mapping.h"
#include "control/io/ethercat/registers.h"

namespace indurop::io::ethercat {

namespace {

constexpr unsigned kMailboxManagers = 2;
constexpr std::uint8_t kFmmuReads = 1;
constexpr std::uint8_t kFmmuWrites = 2;

std::size_t bytes_of(const std::vector<Pdo>& pdos, std::size_t manager) {
  std::size_t bits = 0;
  for (const Pdo& pdo : pdos) {
    bits += pdo.sync_manager == manager ? bits_of(pdo) : 0;
  }
  return (bits + 7) / 8;
}

void append_manager(std::vector<std::uint8_t>& to, const SyncManagerEntry& entry, std::size_t length) {
  const std::size_t at = to.size();
  to.resize(at + kSyncManagerBytes);
  store<std::uint16_t>(to, at, entry.start);
  store<std::uint16_t>(to, at + 2, static_cast<std::uint16_t>(length));
  to[at + 4] = entry.control;
  to[at + 6] = length > 0 ? 1 : 0;
}

void append_fmmu(std::vector<std::uint8_t>& to, std::uint32_t logical, std::size_t length, std::uint16_t physical,
                 std::uint8_t type) {
  const std::size_t at = to.size();
  to.resize(at + kFmmuBytes);
  store<std::uint32_t>(to, at, logical);
  store<std::uint16_t>(to, at + 4, static_cast<std::uint16_t>(length));
  to[at + 7] = 7;  // whole bytes
  store<std::uint16_t>(to, at + 8, physical);
  to[at + 11] = type;
  to[at + 12] = 1;
}

template <class T>
StartObject object_of(std::uint16_t index, std::size_t subindex, T value) {
  StartObject object{index, static_cast<std::uint8_t>(subindex), false, std::vector<std::uint8_t>(sizeof(T))};
  store<T>(object.value, 0, value);
  return object;
}

void append_contents(std::vector<StartObject>& to, const Pdo& pdo) {
  to.push_back(object_of<std::uint8_t>(pdo.index, 0, 0));
  for (std::size_t i = 0; i < pdo.entries.size(); ++i) {
    const PdoEntry& entry = pdo.entries[i];
    to.push_back(object_of<std::uint32_t>(pdo.index, i + 1,
                                          static_cast<std::uint32_t>(entry.index) << 16U |
                                              static_cast<std::uint32_t>(entry.subindex) << 8U | entry.bits));
  }
  to.push_back(object_of<std::uint8_t>(pdo.index, 0, static_cast<std::uint8_t>(pdo.entries.size())));
}

// What a SyncManager exchanges, also if it is what the slave begins with: another program may have changed it. A PDO is
// filled while it is not assigned.
void append_mapping(std::vector<StartObject>& to, const Sii& sii, const std::vector<Pdo>& pdos, std::size_t manager) {
  const auto assignment = static_cast<std::uint16_t>(kPdoAssignment + manager);
  std::vector<const Pdo*> assigned;
  to.push_back(object_of<std::uint8_t>(assignment, 0, 0));
  for (const Pdo& pdo : pdos) {
    if (pdo.sync_manager != manager) {
      continue;
    }
    assigned.push_back(&pdo);
    if (may_fill(sii, pdo)) {
      append_contents(to, pdo);
    }
  }
  for (std::size_t i = 0; i < assigned.size(); ++i) {
    to.push_back(object_of<std::uint16_t>(assignment, i + 1, assigned[i]->index));
  }
  to.push_back(object_of<std::uint8_t>(assignment, 0, static_cast<std::uint8_t>(assigned.size())));
}

}  // namespace

SlavePlan plan_of(const Sii& sii, std::uint32_t logical) {
  SlavePlan plan;
  plan.name = sii.name;
  plan.identity = sii.identity;
  plan.logical = logical;
  plan.uses_lrw = !sii.no_lrw;
  plan.identity.serial = 0;
  const bool has_mailbox = sii.mailbox.receive_size > 0 && sii.sync_managers.size() >= kMailboxManagers;
  const std::size_t first = has_mailbox ? kMailboxManagers : 0;
  if (has_mailbox) {
    plan.mailbox = sii.mailbox;
    SyncManagerEntry entry = sii.sync_managers[0];
    entry.start = sii.mailbox.receive_at;
    append_manager(plan.mailbox_managers, entry, sii.mailbox.receive_size);
    entry = sii.sync_managers[1];
    entry.start = sii.mailbox.send_at;
    append_manager(plan.mailbox_managers, entry, sii.mailbox.send_size);
  }
  plan.process_managers_at = static_cast<std::uint16_t>(reg::kSyncManager + first * kSyncManagerBytes);
  for (const auto use : {SyncManagerUse::Outputs, SyncManagerUse::Inputs}) {
    const bool out = use == SyncManagerUse::Outputs;
    auto& bytes = out ? plan.output_bytes : plan.input_bytes;
    for (std::size_t i = first; i < sii.sync_managers.size(); ++i) {
      const auto& entry = sii.sync_managers[i];
      const std::size_t length = bytes_of(out ? sii.outputs : sii.inputs, i);
      if (entry.use == use && length > 0) {
        append_fmmu(plan.fmmus, static_cast<std::uint32_t>(logical + plan.output_bytes + plan.input_bytes), length,
                    entry.start, out ? kFmmuWrites : kFmmuReads);
        bytes += length;
      }
    }
  }
  for (std::size_t i = first; i < sii.sync_managers.size(); ++i) {
    const auto& entry = sii.sync_managers[i];
    const bool out = entry.use == SyncManagerUse::Outputs;
    const auto& pdos = out ? sii.outputs : sii.inputs;
    append_manager(plan.process_managers, entry, bytes_of(pdos, i));
    if (has_mailbox && may_assign(sii) && !pdos.empty() && (out || entry.use == SyncManagerUse::Inputs)) {
      append_mapping(plan.start_objects, sii, pdos, i);
    }
  }
  plan.safe_outputs.assign(plan.output_bytes, 0);
  return plan;
}

}  // namespace indurop::io::ethercat
