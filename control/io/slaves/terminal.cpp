// SPDX-License-Identifier: Apache-2.0
#include "control/io/slaves/terminal.h"

#include <algorithm>
#include <map>
#include <utility>

#include "control/io/ethercat/simulator/sii_image.h"

namespace indurop::io::slaves {

namespace {

using ethercat::ObjectDictionary;

void add_entries(const std::vector<ethercat::Pdo>& pdos, bool writable, ObjectDictionary& objects,
                 std::map<std::uint16_t, std::uint8_t>& last) {
  for (const ethercat::Pdo& pdo : pdos) {
    for (const ethercat::PdoEntry& entry : pdo.entries) {
      if (entry.index != 0 && objects.storage(entry.index, entry.subindex).empty()) {
        objects.add(entry.index, entry.subindex, std::vector<std::uint8_t>((entry.bits + 7U) / 8U), writable);
        objects.describe(entry.index, entry.subindex, entry.type, entry.name);
        last[entry.index] = std::max(last[entry.index], entry.subindex);
      }
    }
  }
}

}  // namespace

ethercat::SlaveConfig Terminal::slave(const ethercat::Sii& sii, std::vector<std::uint8_t> image) {
  ethercat::SlaveConfig config;
  config.esc.eeprom = image.empty() ? ethercat::sii_image(sii) : std::move(image);
  if (sii.no_lrw) {
    config.esc.features |= ethercat::kNoLrw;
  }
  ObjectDictionary& objects = config.objects;
  objects.add_number<std::uint32_t>(0x1000, 0, 0x00001389, false);  // a modular device
  objects.add(0x1008, 0, {sii.name.begin(), sii.name.end()}, false);
  objects.add_number<std::uint8_t>(0x1018, 0, 4, false);
  objects.add_number<std::uint32_t>(0x1018, 1, sii.identity.vendor, false);
  objects.add_number<std::uint32_t>(0x1018, 2, sii.identity.product, false);
  objects.add_number<std::uint32_t>(0x1018, 3, sii.identity.revision, false);
  objects.add_number<std::uint32_t>(0x1018, 4, sii.identity.serial, false);
  std::map<std::uint16_t, std::uint8_t> last;  // subindices
  add_entries(sii.outputs, true, objects, last);
  add_entries(sii.inputs, false, objects, last);
  for (const auto& [index, count] : last) {
    if (objects.storage(index, 0).empty()) {
      objects.add_number<std::uint8_t>(index, 0, count, false);
    }
  }
  return config;
}

void Terminal::compute(ethercat::Bytes outputs, std::span<std::uint8_t> inputs) {
  if (!outputs.empty()) {
    mapped_->take(outputs);
  }
  mapped_->give(inputs);
}

}  // namespace indurop::io::slaves
