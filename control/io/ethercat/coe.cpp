// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/coe.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kTypeAt = 5;
constexpr unsigned kNibble = 4;
constexpr unsigned kServiceShift = 12;

struct AbortText {
  std::uint32_t code;
  std::string_view text;
};

constexpr std::array kAborts = {
    AbortText{0x05030000, "the toggle bit did not change"},
    AbortText{0x05040000, "timeout of the SDO protocol"},
    AbortText{0x05040001, "the command is invalid or unknown"},
    AbortText{0x05040005, "out of memory"},
    AbortText{0x06010000, "access to the object is not supported"},
    AbortText{0x06010001, "the object can only be written"},
    AbortText{0x06010002, "the object can only be read"},
    AbortText{0x06010003, "the subindex cannot be written, subindex 0 has to be 0"},
    AbortText{0x06010004, "the object has no complete access"},
    AbortText{0x06010005, "the object is longer than the mailbox"},
    AbortText{0x06010006, "the object is mapped to a PDO, a download is blocked"},
    AbortText{0x06020000, "there is no such object"},
    AbortText{0x06040041, "the object cannot be mapped to a PDO"},
    AbortText{0x06040042, "the mapped objects are longer than the PDO"},
    AbortText{0x06040043, "parameters are incompatible"},
    AbortText{0x06040047, "incompatibility inside of the device"},
    AbortText{0x06060000, "access failed due to a hardware error"},
    AbortText{0x06070010, "the length does not fit the data type"},
    AbortText{0x06070012, "the length is too high"},
    AbortText{0x06070013, "the length is too low"},
    AbortText{0x06090011, "there is no such subindex"},
    AbortText{0x06090030, "the value is outside of its range"},
    AbortText{0x06090031, "the value is too high"},
    AbortText{0x06090032, "the value is too low"},
    AbortText{0x06090036, "the maximum is below the minimum"},
    AbortText{0x08000000, "general error"},
    AbortText{0x08000020, "the value cannot be transferred or stored"},
    AbortText{0x08000021, "the value cannot be transferred: local control"},
    AbortText{0x08000022, "the value cannot be transferred in this state of the device"},
    AbortText{0x08000023, "there is no object dictionary"},
};

}  // namespace

void write_mailbox_header(std::span<std::uint8_t> to, std::size_t size, MailboxType type,
                          std::uint8_t counter) noexcept {
  store<std::uint16_t>(to, 0, static_cast<std::uint16_t>(size));
  store<std::uint16_t>(to, 2, 0);  // from or to the master
  to[4] = 0;
  to[kTypeAt] = static_cast<std::uint8_t>(static_cast<unsigned>(type) | static_cast<unsigned>(counter) << kNibble);
}

void write_coe_header(std::span<std::uint8_t> to, CoeService service) noexcept {
  store<std::uint16_t>(to, kMailboxHeader, static_cast<std::uint16_t>(static_cast<unsigned>(service) << kServiceShift));
}

std::optional<Mailbox> read_mailbox(Bytes bytes) noexcept {
  if (bytes.size() < kMailboxHeader) {
    return std::nullopt;
  }
  const auto size = load<std::uint16_t>(bytes, 0);
  if (size > bytes.size() - kMailboxHeader) {
    return std::nullopt;
  }
  const unsigned type = bytes[kTypeAt];
  return Mailbox{static_cast<MailboxType>(type & 0x0FU), static_cast<std::uint8_t>(type >> kNibble & kLastCounter),
                 bytes.subspan(kMailboxHeader, size)};
}

std::optional<CoeService> service_of(const Mailbox& mailbox) noexcept {
  if (mailbox.type != MailboxType::Coe || mailbox.data.size() < 2) {
    return std::nullopt;
  }
  return static_cast<CoeService>(load<std::uint16_t>(mailbox.data, 0) >> kServiceShift);
}

std::string_view sdo_abort_text(std::uint32_t code) noexcept {
  const auto* const found =
      std::find_if(kAborts.begin(), kAborts.end(), [code](const AbortText& known) { return known.code == code; });
  return found == kAborts.end() ? "a reason of the maker's own" : found->text;
}

}  // namespace indurop::io::ethercat
