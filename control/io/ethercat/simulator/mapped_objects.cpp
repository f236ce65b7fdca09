// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/mapped_objects.h"

namespace indurop::io::ethercat {

namespace {

// What the master has written: the entries of all PDOs, one after the other.
std::vector<PdoEntry> mapped_entries(const ObjectDictionary& objects, std::uint16_t assignment) {
  std::vector<PdoEntry> entries;
  for (std::uint64_t i = 1; i <= objects.number(assignment, 0); ++i) {
    const auto pdo = static_cast<std::uint16_t>(objects.number(assignment, static_cast<std::uint8_t>(i)));
    for (std::uint64_t k = 1; k <= objects.number(pdo, 0); ++k) {
      const std::uint64_t entry = objects.number(pdo, static_cast<std::uint8_t>(k));
      entries.push_back({static_cast<std::uint16_t>(entry >> 16U),
                         static_cast<std::uint8_t>(entry >> 8U),
                         static_cast<std::uint8_t>(entry),
                         0,
                         {}});
    }
  }
  return entries;
}

std::vector<PdoEntry> own_entries(const std::vector<Pdo>& pdos) {
  std::vector<PdoEntry> entries;
  for (const Pdo& pdo : pdos) {
    if (pdo.sync_manager != kNotAssigned) {
      entries.insert(entries.end(), pdo.entries.begin(), pdo.entries.end());
    }
  }
  return entries;
}

}  // namespace

std::vector<MappedObjects::Place> MappedObjects::places(SyncManagerUse use) const {
  const auto assignment = static_cast<std::uint16_t>(kPdoAssignment + first_manager(sii_, use));
  const auto entries = objects_.has(assignment)
                           ? mapped_entries(objects_, assignment)
                           : own_entries(use == SyncManagerUse::Outputs ? sii_.outputs : sii_.inputs);
  std::vector<Place> found;
  std::size_t bit = 0;
  for (const PdoEntry& entry : entries) {
    const auto value = objects_.storage(entry.index, entry.subindex);
    if (entry.bits <= 8 * value.size()) {
      found.push_back({value, bit, entry.bits});
    }
    bit += entry.bits;
  }
  return found;
}

void MappedObjects::refresh() {
  if (changes_ != objects_.changes()) {
    changes_ = objects_.changes();
    outputs_ = places(SyncManagerUse::Outputs);
    inputs_ = places(SyncManagerUse::Inputs);
  }
}

void MappedObjects::take(Bytes outputs) {
  refresh();
  for (const Place& place : outputs_) {
    if (place.bit + place.bits <= 8 * outputs.size()) {
      copy_bits(outputs, place.bit, place.value, 0, place.bits);
    }
  }
}

void MappedObjects::give(std::span<std::uint8_t> inputs) {
  refresh();
  for (const Place& place : inputs_) {
    if (place.bit + place.bits <= 8 * inputs.size()) {
      copy_bits(place.value, 0, inputs, place.bit, place.bits);
    }
  }
}

}  // namespace indurop::io::ethercat
