// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/sii_image.h"

#include <algorithm>
#include <string>
#include <utility>

namespace indurop::io::ethercat {

namespace {

class ImageWriter {
 public:
  template <class T>
  void put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    store<T>(bytes_, at, value);
  }
  void put_text(const std::string& text) {
    constexpr std::size_t kMost = 255;  // texts, and bytes of one
    std::uint8_t number = 0;
    const std::string kept = text.substr(0, kMost);
    auto found = std::find(texts_.begin(), texts_.end(), kept);
    if (!kept.empty() && found == texts_.end() && texts_.size() < kMost) {
      found = texts_.insert(found, kept);
    }
    if (!kept.empty() && found != texts_.end()) {
      number = static_cast<std::uint8_t>(found - texts_.begin() + 1);
    }
    put(number);
  }
  void put_zeros(std::size_t count) { bytes_.resize(bytes_.size() + count); }

  void begin(std::uint16_t category) {
    put(category);
    put<std::uint16_t>(0);
    first_ = bytes_.size();
  }
  // A category without content is left out, as in EEPROMs of real slaves: masters read its first entry unseen.
  void end() {
    if (bytes_.size() == first_) {
      bytes_.resize(first_ - 2 * sizeof(std::uint16_t));
      return;
    }
    put_zeros((bytes_.size() - first_) % 2);
    store<std::uint16_t>(bytes_, first_ - 2, static_cast<std::uint16_t>((bytes_.size() - first_) / 2));
  }
  void put_texts() {
    begin(kSiiStrings);
    put(static_cast<std::uint8_t>(texts_.size()));
    for (const std::string& text : texts_) {
      put(static_cast<std::uint8_t>(text.size()));
      bytes_.insert(bytes_.end(), text.begin(), text.end());
    }
    end();
  }
  std::vector<std::uint8_t>& bytes() noexcept { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::vector<std::string> texts_;
  std::size_t first_ = 0;
};

void put_mailbox(ImageWriter& writer, const MailboxArea& area) {
  writer.put(area.receive_at);
  writer.put(area.receive_size);
  writer.put(area.send_at);
  writer.put(area.send_size);
}

void put_fixed_part(ImageWriter& writer, const Sii& sii) {
  writer.put(sii.pdi_control);
  writer.put_zeros(6);
  writer.put(sii.alias);
  writer.put_zeros(4);
  writer.put<std::uint16_t>(sii_checksum(writer.bytes()));
  writer.put(sii.identity.vendor);
  writer.put(sii.identity.product);
  writer.put(sii.identity.revision);
  writer.put(sii.identity.serial);
  writer.put_zeros(8);
  put_mailbox(writer, sii.bootstrap);
  put_mailbox(writer, sii.mailbox);
  writer.put(sii.protocols);
  writer.put_zeros(std::size_t{2} * kSiiCategories - writer.bytes().size());
}

void put_pdos(ImageWriter& writer, std::uint16_t category, const std::vector<Pdo>& pdos) {
  writer.begin(category);
  for (const Pdo& pdo : pdos) {
    writer.put(pdo.index);
    writer.put(static_cast<std::uint8_t>(pdo.entries.size()));
    writer.put(pdo.sync_manager);
    writer.put_zeros(1);
    writer.put_text(pdo.name);
    writer.put(pdo.flags);
    for (const PdoEntry& entry : pdo.entries) {
      writer.put(entry.index);
      writer.put(entry.subindex);
      writer.put_text(entry.name);
      writer.put(entry.type);
      writer.put(entry.bits);
      writer.put_zeros(2);
    }
  }
  writer.end();
}

void put_clocks(ImageWriter& writer, const std::vector<ClockMode>& clocks) {
  writer.begin(kSiiClocks);
  for (const ClockMode& mode : clocks) {
    writer.put(mode.cycle0);
    writer.put(mode.shift0);
    writer.put(mode.shift1);
    writer.put(mode.factor1);
    writer.put(mode.assign_activate);
    writer.put(mode.factor0);
    writer.put_text(mode.name);
    writer.put_zeros(5);
  }
  writer.end();
}

}  // namespace

std::vector<std::uint8_t> sii_image(const Sii& sii) {
  ImageWriter writer;
  put_fixed_part(writer, sii);
  writer.begin(kSiiGeneral);
  writer.put_text(sii.group);
  writer.put_text(sii.image);
  writer.put_text(sii.order);
  writer.put_text(sii.name);
  writer.put_zeros(1);
  writer.put(sii.coe_details);
  writer.put_zeros(5);
  writer.put(sii.no_lrw ? kSiiNoLrw : std::uint8_t{0});
  writer.put(sii.ebus_milliamperes);
  writer.put_zeros(18);
  writer.end();
  writer.begin(kSiiFmmus);
  for (const FmmuUse use : sii.fmmus) {
    writer.put(static_cast<std::uint8_t>(use));
  }
  writer.end();
  writer.begin(kSiiSyncManagers);
  for (const SyncManagerEntry& entry : sii.sync_managers) {
    writer.put(entry.start);
    writer.put(entry.length);
    writer.put(entry.control);
    writer.put_zeros(1);
    writer.put(entry.enable);
    writer.put(static_cast<std::uint8_t>(entry.use));
  }
  writer.end();
  put_pdos(writer, kSiiTxPdos, sii.inputs);
  put_pdos(writer, kSiiRxPdos, sii.outputs);
  put_clocks(writer, sii.clocks);
  writer.put_texts();
  writer.put<std::uint16_t>(0xFFFF);
  return std::move(writer.bytes());
}

}  // namespace indurop::io::ethercat
