// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/frame.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kSourceMac = 6;
constexpr std::size_t kEtherType = 12;
constexpr std::uint8_t kEtherTypeHigh = 0x88;
constexpr std::uint8_t kEtherTypeLow = 0xA4;

// The word before the datagrams: length and type.
constexpr unsigned kLengthMask = 0x07FF;
constexpr unsigned kTypeShift = 12;
constexpr unsigned kTypeCommands = 1;

// Offsets in the header of a datagram, and the flags in its length.
constexpr std::size_t kIndex = 1;
constexpr std::size_t kAddress = 2;
constexpr std::size_t kLength = 6;
constexpr std::size_t kInterrupt = 8;
constexpr unsigned kCirculating = 0x4000;
constexpr unsigned kMore = 0x8000;

}  // namespace

std::string_view to_string(Command command) noexcept {
  static constexpr std::array<std::string_view, kLastCommand + 1> kNames = {
      "NOP", "APRD", "APWR", "APRW", "FPRD", "FPWR", "FPRW", "BRD", "BWR", "BRW", "LRD", "LWR", "LRW", "ARMW", "FRMW"};
  const auto number = static_cast<std::size_t>(command);
  return number < kNames.size() ? kNames[number] : "unknown command";
}

std::string_view to_string(FrameFault fault) noexcept {
  switch (fault) {
    case FrameFault::None:
      return "no fault";
    case FrameFault::NotEtherCat:
      return "not an EtherCAT frame";
    case FrameFault::NoCommands:
      return "an EtherCAT frame without commands";
    case FrameFault::TooShort:
      return "shorter than its header says";
    case FrameFault::NoDatagram:
      return "no datagram";
    case FrameFault::BrokenDatagram:
      break;
  }
  return "a datagram is broken";
}

FrameBuilder::FrameBuilder(const Mac& source) noexcept {
  std::fill_n(bytes_.begin(), kSourceMac, std::uint8_t{0xFF});
  std::copy(source.begin(), source.end(), bytes_.begin() + kSourceMac);
  bytes_[kEtherType] = kEtherTypeHigh;
  bytes_[kEtherType + 1] = kEtherTypeLow;
}

void FrameBuilder::clear() noexcept {
  end_ = kFrameHeader;
  last_ = 0;
}

std::optional<std::size_t> FrameBuilder::add(Command command, std::uint8_t index, std::uint32_t address,
                                             Bytes data) noexcept {
  const auto at = add(command, index, address, data.size());
  if (at) {
    std::copy(data.begin(), data.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(*at));
  }
  return at;
}

std::optional<std::size_t> FrameBuilder::add(Command command, std::uint8_t index, std::uint32_t address,
                                             std::size_t length) noexcept {
  if (length > kMaxFrame || end_ + length + kDatagramOverhead > kMaxFrame) {
    return std::nullopt;
  }
  if (last_ != 0) {
    store<std::uint16_t>(bytes_, last_ + kLength, load<std::uint16_t>(bytes_, last_ + kLength) | kMore);
  }
  const std::size_t at = end_;
  last_ = at;
  end_ = at + length + kDatagramOverhead;
  std::fill(bytes_.begin() + static_cast<std::ptrdiff_t>(at), bytes_.begin() + static_cast<std::ptrdiff_t>(end_),
            std::uint8_t{0});
  bytes_[at] = static_cast<std::uint8_t>(command);
  bytes_[at + kIndex] = index;
  store<std::uint32_t>(bytes_, at + kAddress, address);
  store<std::uint16_t>(bytes_, at + kLength, static_cast<std::uint16_t>(length));
  return at + kDatagramHeader;
}

void FrameBuilder::fill(std::size_t data_at, Bytes data) noexcept {
  std::copy_n(data.begin(), std::min(data.size(), end_ - data_at),
              bytes_.begin() + static_cast<std::ptrdiff_t>(data_at));
}

Bytes FrameBuilder::finish() noexcept {
  store<std::uint16_t>(bytes_, kEthernetHeader,
                       static_cast<std::uint16_t>((end_ - kFrameHeader) | kTypeCommands << kTypeShift));
  const std::size_t size = std::max(end_, kMinFrame);
  std::fill(bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin() + static_cast<std::ptrdiff_t>(size),
            std::uint8_t{0});
  return std::span(bytes_).first(size);
}

FrameReader::FrameReader(Bytes frame) noexcept : frame_(frame), fault_(FrameFault::NotEtherCat) {
  if (frame.size() < kFrameHeader || frame[kEtherType] != kEtherTypeHigh || frame[kEtherType + 1] != kEtherTypeLow) {
    return;
  }
  const auto header = load<std::uint16_t>(frame, kEthernetHeader);
  end_ = kFrameHeader + (header & kLengthMask);
  if (header >> kTypeShift != kTypeCommands) {
    fault_ = FrameFault::NoCommands;
  } else if (end_ > frame.size()) {
    fault_ = FrameFault::TooShort;
  } else {
    fault_ = walk();
  }
  if (fault_ != FrameFault::None) {
    at_ = end_;
  }
}

FrameFault FrameReader::walk() noexcept {
  if (end_ == kFrameHeader) {
    return FrameFault::NoDatagram;
  }
  bool more = true;
  std::size_t at = kFrameHeader;
  while (more) {
    if (end_ - at < kDatagramOverhead || frame_[at] > kLastCommand) {
      return FrameFault::BrokenDatagram;
    }
    const auto flags = load<std::uint16_t>(frame_, at + kLength);
    at += (flags & kLengthMask) + kDatagramOverhead;
    if (at > end_) {
      return FrameFault::BrokenDatagram;
    }
    more = (flags & kMore) != 0;
  }
  end_ = at;  // some masters count bytes after the last datagram, too
  return FrameFault::None;
}

bool FrameReader::next(Datagram& datagram) noexcept {
  if (at_ >= end_) {
    return false;
  }
  const auto flags = load<std::uint16_t>(frame_, at_ + kLength);
  datagram.at = at_;
  datagram.command = static_cast<Command>(frame_[at_]);
  datagram.index = frame_[at_ + kIndex];
  datagram.address = load<std::uint32_t>(frame_, at_ + kAddress);
  datagram.length = static_cast<std::uint16_t>(flags & kLengthMask);
  datagram.circulating = (flags & kCirculating) != 0;
  datagram.interrupt = load<std::uint16_t>(frame_, at_ + kInterrupt);
  datagram.wkc = load<std::uint16_t>(frame_, datagram.wkc_at());
  at_ = datagram.wkc_at() + 2;
  return true;
}

}  // namespace indurop::io::ethercat
