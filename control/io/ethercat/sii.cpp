// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/sii.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kChecksummed = 14;  // bytes
constexpr std::size_t kWord = 2;

// Bytes of the fixed part.
constexpr std::size_t kAliasAt = 0x08;
constexpr std::size_t kChecksumAt = 0x0E;
constexpr std::size_t kBootstrapAt = 0x28;
constexpr std::size_t kMailboxAt = 0x30;
constexpr std::size_t kProtocolsAt = 0x38;

constexpr std::size_t kGeneralBytes = 14;  // as far as it is read
constexpr std::size_t kPdoBytes = 8;
constexpr std::size_t kClockBytes = 24;

MailboxArea mailbox_at(Bytes image, std::size_t at) {
  return {load<std::uint16_t>(image, at), load<std::uint16_t>(image, at + 2), load<std::uint16_t>(image, at + 4),
          load<std::uint16_t>(image, at + 6)};
}

// Fills a Sii from categories. Each returns what is wrong, or nothing.
class SiiReader {
 public:
  explicit SiiReader(Sii& sii) : sii_(sii) {}

  std::optional<std::string> read_strings(Bytes bytes) {
    if (bytes.empty()) {
      return std::nullopt;
    }
    std::size_t at = 1;
    for (unsigned i = 0; i < bytes[0]; ++i) {
      if (at >= bytes.size() || bytes[at] > bytes.size() - at - 1) {
        return fmt::format("text {} of {} is longer than the category", i + 1, bytes[0]);
      }
      const auto text = bytes.subspan(at + 1, bytes[at]);
      // Some images fill texts up with zeros.
      sii_.strings.emplace_back(text.begin(), std::find(text.begin(), text.end(), std::uint8_t{0}));
      at += std::size_t{1} + bytes[at];
    }
    return std::nullopt;
  }

  std::optional<std::string> read_general(Bytes bytes) {
    if (bytes.size() < kGeneralBytes) {
      return fmt::format("it needs {} bytes, it has {}", kGeneralBytes, bytes.size());
    }
    std::copy_n(bytes.begin(), general_.size(), general_.begin());
    sii_.coe_details = bytes[5];
    sii_.no_lrw = (bytes[kSiiFlagsAt] & kSiiNoLrw) != 0;
    sii_.ebus_milliamperes = load<std::int16_t>(bytes, 12);
    return std::nullopt;
  }

  std::optional<std::string> read_fmmus(Bytes bytes) {
    for (const std::uint8_t use : bytes) {
      sii_.fmmus.push_back(use <= 3 ? static_cast<FmmuUse>(use) : FmmuUse::Unused);
    }
    return std::nullopt;
  }

  std::optional<std::string> read_sync_managers(Bytes bytes) {
    for (std::size_t at = 0; at + kPdoBytes <= bytes.size(); at += kPdoBytes) {
      SyncManagerEntry entry;
      entry.start = load<std::uint16_t>(bytes, at);
      entry.length = load<std::uint16_t>(bytes, at + 2);
      entry.control = bytes[at + 4];
      entry.enable = bytes[at + 6];
      entry.use = bytes[at + 7] <= 4 ? static_cast<SyncManagerUse>(bytes[at + 7]) : SyncManagerUse::None;
      sii_.sync_managers.push_back(entry);
    }
    return std::nullopt;
  }

  std::optional<std::string> read_pdos(Bytes bytes, std::vector<Pdo>& pdos, std::vector<std::uint8_t>& names) {
    std::size_t at = 0;
    while (at + kPdoBytes <= bytes.size()) {
      Pdo pdo;
      pdo.index = load<std::uint16_t>(bytes, at);
      const std::size_t entries = bytes[at + 2];
      pdo.sync_manager = bytes[at + 3];
      names.push_back(bytes[at + 5]);
      pdo.flags = load<std::uint16_t>(bytes, at + 6);
      at += kPdoBytes;
      if (entries * kPdoBytes > bytes.size() - at) {
        return fmt::format("PDO {:04x}h has {} entries, more than the category", pdo.index, entries);
      }
      for (std::size_t i = 0; i < entries; ++i, at += kPdoBytes) {
        pdo.entries.push_back({load<std::uint16_t>(bytes, at), bytes[at + 2], bytes[at + 5], bytes[at + 4], {}});
        names.push_back(bytes[at + 3]);
      }
      pdos.push_back(std::move(pdo));
    }
    return std::nullopt;
  }

  std::optional<std::string> read_clocks(Bytes bytes) {
    for (std::size_t at = 0; at + kClockBytes <= bytes.size(); at += kClockBytes) {
      ClockMode mode;
      mode.cycle0 = load<std::uint32_t>(bytes, at);
      mode.shift0 = load<std::uint32_t>(bytes, at + 4);
      mode.shift1 = load<std::uint32_t>(bytes, at + 8);
      mode.factor1 = load<std::int16_t>(bytes, at + 12);
      mode.assign_activate = load<std::uint16_t>(bytes, at + 14);
      mode.factor0 = load<std::int16_t>(bytes, at + 16);
      clock_names_.push_back(bytes[at + 18]);
      sii_.clocks.push_back(std::move(mode));
    }
    return std::nullopt;
  }

  std::optional<std::string> read(std::uint16_t category, Bytes bytes) {
    switch (category) {
      case kSiiStrings:
        return read_strings(bytes);
      case kSiiGeneral:
        return read_general(bytes);
      case kSiiFmmus:
        return read_fmmus(bytes);
      case kSiiSyncManagers:
        return read_sync_managers(bytes);
      case kSiiTxPdos:
        return read_pdos(bytes, sii_.inputs, input_names_);
      case kSiiRxPdos:
        return read_pdos(bytes, sii_.outputs, output_names_);
      case kSiiClocks:
        return read_clocks(bytes);
      default:
        return std::nullopt;  // the maker's own
    }
  }

  // Numbers of texts become texts: the category with them may be the last.
  void name_all() {
    sii_.group = text(general_[0]);
    sii_.image = text(general_[1]);
    sii_.order = text(general_[2]);
    sii_.name = text(general_[3]);
    name_pdos(sii_.inputs, input_names_);
    name_pdos(sii_.outputs, output_names_);
    for (std::size_t i = 0; i < sii_.clocks.size(); ++i) {
      sii_.clocks[i].name = text(clock_names_[i]);
    }
  }

 private:
  [[nodiscard]] std::string text(std::size_t number) const {
    return number == 0 || number > sii_.strings.size() ? std::string() : sii_.strings[number - 1];
  }

  void name_pdos(std::vector<Pdo>& pdos, const std::vector<std::uint8_t>& names) {
    auto name = names.begin();
    for (Pdo& pdo : pdos) {
      pdo.name = text(*name++);
      for (PdoEntry& entry : pdo.entries) {
        entry.name = text(*name++);
      }
    }
  }

  Sii& sii_;
  std::array<std::uint8_t, 4> general_{};
  std::vector<std::uint8_t> input_names_;
  std::vector<std::uint8_t> output_names_;
  std::vector<std::uint8_t> clock_names_;
};

void read_fixed_part(Bytes image, Sii& sii) {
  const auto identity = [image](std::size_t number) {
    return load<std::uint32_t>(image, kSiiIdentity * kWord + number * sizeof(std::uint32_t));
  };
  sii.checksum_fits = image[kChecksumAt] == sii_checksum(image);
  sii.pdi_control = load<std::uint16_t>(image, 0);
  sii.alias = load<std::uint16_t>(image, kAliasAt);
  sii.identity = {identity(0), identity(1), identity(2), identity(3)};
  sii.bootstrap = mailbox_at(image, kBootstrapAt);
  sii.mailbox = mailbox_at(image, kMailboxAt);
  sii.protocols = load<std::uint16_t>(image, kProtocolsAt);
}

}  // namespace

std::size_t bits_of(const Pdo& pdo) noexcept {
  std::size_t bits = 0;
  for (const PdoEntry& entry : pdo.entries) {
    bits += entry.bits;
  }
  return bits;
}

const PdoEntry* find_entry(const Pdo& pdo, std::uint16_t index, std::uint8_t subindex) noexcept {
  const auto found = std::find_if(pdo.entries.begin(), pdo.entries.end(), [index, subindex](const PdoEntry& entry) {
    return is_object(entry, index, subindex);
  });
  return found == pdo.entries.end() ? nullptr : &*found;
}

std::uint8_t first_manager(const Sii& sii, SyncManagerUse use) noexcept {
  const auto& managers = sii.sync_managers;
  const auto first = std::find_if(managers.begin(), managers.end(),
                                  [use](const SyncManagerEntry& manager) { return manager.use == use; });
  return first == managers.end() ? kNotAssigned : static_cast<std::uint8_t>(first - managers.begin());
}

std::uint8_t sii_checksum(Bytes image) noexcept {
  constexpr unsigned kPolynomial = 0x07;
  unsigned crc = 0xFF;
  for (std::size_t i = 0; i < kChecksummed; ++i) {
    crc ^= image[i];
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc << 1U) ^ ((crc & 0x80U) != 0 ? kPolynomial : 0U);
    }
  }
  return static_cast<std::uint8_t>(crc);
}

Result<Sii, std::string> read_sii(Bytes image) {
  std::size_t at = kSiiCategories * kWord;
  if (image.size() < at) {
    return fmt::format("the image has {} bytes, its fixed part alone has {}", image.size(), at);
  }
  const auto fixed = image.first(at);
  if (std::all_of(fixed.begin(), fixed.end(), [&fixed](std::uint8_t byte) { return byte == fixed[0]; })) {
    return std::string("the EEPROM is empty; write the maker's image to it");
  }
  Sii sii;
  read_fixed_part(image, sii);
  SiiReader reader(sii);
  while (at + 2 * kWord <= image.size()) {
    const auto category = load<std::uint16_t>(image, at);
    const std::size_t size = kWord * load<std::uint16_t>(image, at + kWord);
    if (category == kSiiEnd || (category == kSiiNop && size == 0 && at > kSiiCategories * kWord)) {
      break;  // some images are filled up with zeros
    }
    if (category == kSiiNop && size == 0) {
      return std::string("the EEPROM has no categories, it is empty; write the maker's image to it");
    }
    const std::size_t begin = at + 2 * kWord;
    if (size > image.size() - begin) {
      return fmt::format("word {:04x}h: category {} has {} bytes, the image ends after {}", at / kWord, category, size,
                         image.size() - begin);
    }
    if (auto problem = reader.read(category, image.subspan(begin, size))) {
      return fmt::format("word {:04x}h: category {}: {}", at / kWord, category, *problem);
    }
    at = begin + size;
  }
  reader.name_all();
  return sii;
}

}  // namespace indurop::io::ethercat
