// SPDX-License-Identifier: Apache-2.0
// A recording of a real bus as requests with their answers, and the slaves that it was made of as far as it tells: what
// their EEPROMs have where the master read them, their objects, and what kind of chip they have.

#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "capture.h"
#include "control/io/ethercat/coe.h"
#include "control/io/ethercat/frame.h"
#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::ethercat {

struct Exchange {
  Time at{0};
  std::vector<std::uint8_t> sent;
  std::vector<std::uint8_t> received;
};

// Answers have a bit in the source address that the first slave sets. Requests without an answer are left out.
inline std::vector<Exchange> exchanges_of(const std::filesystem::path& path) {
  constexpr std::size_t kSource = 6;
  constexpr std::uint8_t kPassed = 0x02;
  std::vector<Exchange> exchanges;
  std::map<std::pair<Command, std::uint8_t>, Packet> waiting;
  std::optional<std::chrono::microseconds> begin;
  for (const auto& packet : packets_of(path)) {
    Datagram first;
    if (!is_ethercat(packet.bytes) || !FrameReader(packet.bytes).next(first)) {
      continue;
    }
    begin = begin.value_or(packet.at);
    const auto key = std::pair(first.command, first.index);
    if ((packet.bytes[kSource] & kPassed) == 0) {
      waiting[key] = packet;
    } else if (const auto asked = waiting.find(key); asked != waiting.end()) {
      exchanges.push_back({asked->second.at - *begin, asked->second.bytes, packet.bytes});
      waiting.erase(asked);
    }
  }
  return exchanges;
}

// What the maker's data sheet says of a chip.
struct Chip {
  std::uint8_t type;
  std::uint8_t revision;
  std::uint8_t fmmus;
  std::uint8_t sync_managers;
  std::uint8_t ram_kilobytes;
};
inline constexpr Chip kEt1100 = {0x11, 0, 8, 8, 8};
inline constexpr Chip kEt1200 = {0x12, 1, 3, 4, 1};
inline constexpr Chip kLan9252 = {0xC0, 2, 3, 4, 4};
inline constexpr Chip kAkdCore = {0x04, 2, 3, 4, 4};  // an IP core, as it says itself

// One datagram, as it was sent and as it came back.
struct Pair {
  Datagram sent;
  Bytes request;
  Datagram received;
  Bytes answer;
  [[nodiscard]] std::uint16_t offset() const { return static_cast<std::uint16_t>(sent.address >> 16U); }
};

template <class Visit>
void for_each_datagram(const Exchange& exchange, const Visit& visit) {
  FrameReader sent(exchange.sent);
  FrameReader received(exchange.received);
  Pair pair;
  while (sent.next(pair.sent) && received.next(pair.received)) {
    pair.request = pair.sent.data(exchange.sent);
    pair.answer = pair.received.data(exchange.received);
    visit(pair);
  }
}

// What a recording tells of its slaves.
class Recording {
 public:
  Recording(std::vector<Exchange> exchanges, const std::vector<Chip>& chips) : slaves_(chips.size()) {
    for (std::size_t i = 0; i < chips.size(); ++i) {
      EscConfig& esc = slaves_[i].config.esc;
      esc.type = chips[i].type;
      esc.revision = chips[i].revision;
      esc.fmmus = chips[i].fmmus;
      esc.sync_managers = chips[i].sync_managers;
      esc.ram_kilobytes = chips[i].ram_kilobytes;
      esc.has_clock = false;
      esc.eeprom_time = Time(0);
      slaves_[i].config.state_time = Time(0);
      slaves_[i].config.mailbox_time = Time(0);
    }
    for (const Exchange& exchange : exchanges) {
      for_each_datagram(exchange, [this](const Pair& pair) { learn(pair); });
    }
    exchanges_ = std::move(exchanges);
  }

  [[nodiscard]] const std::vector<Exchange>& exchanges() const { return exchanges_; }
  // The slave that is addressed; as many as there are: not one.
  [[nodiscard]] std::size_t place_of(const Datagram& datagram) const {
    const auto address = static_cast<std::uint16_t>(datagram.address);
    std::size_t place = slaves_.size();
    if (datagram.command <= Command::Aprw) {
      place = static_cast<std::uint16_t>(0U - address);
    } else if (const auto found = stations_.find(address); datagram.command <= Command::Fprw) {
      place = found == stations_.end() ? place : found->second;
    }
    return std::min(place, slaves_.size());
  }
  // The slave with this image, or with the words of its EEPROM that were read.
  [[nodiscard]] SlaveConfig slave(std::size_t place, const std::vector<std::uint8_t>& image) const {
    SlaveConfig config = slaves_[place].config;
    EscConfig& esc = config.esc;
    esc.eeprom = image.empty() ? slaves_[place].eeprom : image;
    const std::uint16_t pdi =
        esc.pdi_control.value_or(esc.eeprom.empty() ? std::uint16_t{0} : load<std::uint16_t>(esc.eeprom, 0));
    constexpr unsigned kClockUnits = 0x0C00;  // SYNC and LATCH
    esc.has_clock |= (pdi & kClockUnits) != 0;
    for (const auto& [address, value] : slaves_[place].objects) {
      config.objects.add(address.first, address.second, value);
    }
    return config;
  }

 private:
  using Object = std::pair<std::uint16_t, std::uint8_t>;
  struct Learned {
    SlaveConfig config;
    std::vector<std::uint8_t> eeprom;
    std::size_t word = 0;  // that was asked for
    std::map<Object, std::vector<std::uint8_t>> objects;
  };

  void learn(const Pair& pair) {
    const std::size_t place = place_of(pair.sent);
    if (place == slaves_.size() || pair.received.wkc == 0) {
      return;
    }
    Learned& slave = slaves_[place];
    const bool reads = pair.sent.command == Command::Aprd || pair.sent.command == Command::Fprd;
    if (!reads && pair.offset() == reg::kStation) {
      stations_[load<std::uint16_t>(pair.request, 0)] = place;
    } else if (!reads && pair.offset() == reg::kEepromControl && (pair.request[1] & 1U) != 0) {
      slave.word = load<std::uint16_t>(pair.request, 2);
    } else if (pair.offset() >= reg::kMemory) {
      learn_object(slave, reads ? pair.answer : pair.request, reads);
    } else if (reads) {
      learn_registers(slave, pair.offset(), pair.answer);
    }
  }

  static void learn_registers(Learned& slave, std::uint16_t offset, Bytes data) {
    EscConfig& esc = slave.config.esc;
    // The bytes of a register in this answer; none if it is not in it.
    const auto bytes = [offset, data](std::uint16_t at, std::size_t size) {
      return at >= offset && at + size <= offset + data.size() ? data.subspan(at - offset, size) : Bytes();
    };
    if (const auto found = bytes(reg::kType, 4); !found.empty()) {
      esc.build = load<std::uint16_t>(found, 2);
    }
    if (const auto found = bytes(reg::kPorts, 1); !found.empty()) {
      esc.ports = found[0];
    }
    if (const auto found = bytes(reg::kFeatures, 2); !found.empty()) {
      esc.features = load<std::uint16_t>(found, 0);
    }
    if (const auto found = bytes(reg::kDlStatus, 1); !found.empty()) {
      esc.dl_status = found[0] & 0x0FU;
    }
    if (const auto found = bytes(reg::kPdiControl, 2); !found.empty()) {
      esc.pdi_control = load<std::uint16_t>(found, 0);
    }
    if (const auto found = bytes(reg::kEepromControl, 1); !found.empty()) {
      esc.eeprom_features = found[0] & 0xE0U;
    }
    if (const auto found = bytes(reg::kEepromData, 4); !found.empty()) {
      const auto all = bytes(reg::kEepromData, 8);
      learn_eeprom(slave, all.empty() || (esc.eeprom_features & kEepromEightBytes) == 0 ? found : all);
    }
    esc.has_clock |= offset >= reg::kSystemTime && offset < 0x0A00;
  }

  static void learn_eeprom(Learned& slave, Bytes found) {
    const std::size_t at = 2 * slave.word;
    slave.eeprom.resize(std::max(slave.eeprom.size(), at + found.size()));
    std::copy(found.begin(), found.end(), slave.eeprom.begin() + static_cast<std::ptrdiff_t>(at));
  }

  // The first value of each object that a request or an answer has; of complete access each subindex, by its length.
  static void learn_object(Learned& slave, Bytes message, bool is_answer) {
    const auto mailbox = read_mailbox(message);
    const auto service = mailbox ? service_of(*mailbox) : std::nullopt;
    if (!service || mailbox->data.size() < 10 || mailbox->type != MailboxType::Coe) {
      return;
    }
    const Bytes sdo = mailbox->data;
    const unsigned command = sdo[2];
    const unsigned kind = command & kSdoCommandMask;
    const bool has_value = is_answer ? service == CoeService::SdoResponse && kind == kSdoUpload
                                     : service == CoeService::SdoRequest && kind == kSdoDownload;
    if (!has_value) {
      return;
    }
    const auto index = load<std::uint16_t>(sdo, 3);
    Bytes value = (command & kSdoExpedited) != 0 ? sdo.subspan(6, 4 - (command >> 2U & 3U))
                                                 : sdo.subspan(10, std::min<std::size_t>(sdo.size() - 10, sdo[6]));
    std::uint8_t subindex = sdo[5];
    if ((command & kSdoComplete) == 0) {
      keep(slave, {index, subindex}, value, is_answer);
      return;
    }
    keep(slave, {index, subindex}, value.first(1), is_answer);
    value = value.subspan(2);
    const std::size_t each = index == 0x1C00 ? 1 : index < 0x1D00 && index > 0x1C00 ? 2 : 4;
    for (; value.size() >= each; value = value.subspan(each)) {
      keep(slave, {index, ++subindex}, value.first(each), is_answer);
    }
  }
  static void keep(Learned& slave, Object object, Bytes value, bool is_answer) {
    std::vector<std::uint8_t> bytes(value.size());
    if (is_answer) {
      bytes.assign(value.begin(), value.end());
    }
    slave.objects.emplace(object, std::move(bytes));
  }

  std::vector<Learned> slaves_;
  std::map<std::uint16_t, std::size_t> stations_;
  std::vector<Exchange> exchanges_;
};

}  // namespace indurop::io::ethercat
