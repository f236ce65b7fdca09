// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/foe.h"

#include <algorithm>
#include <array>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kNumberAt = 2;

struct ErrorText {
  std::uint32_t code;
  std::string_view text;
};
constexpr std::array kErrors = {
    ErrorText{0x8000, "an error that is not defined"},
    ErrorText{0x8001, "there is no such file"},
    ErrorText{0x8002, "access is denied"},
    ErrorText{0x8003, "no room for it"},
    ErrorText{0x8004, "not allowed now"},
    ErrorText{0x8005, "a packet has the wrong number"},
    ErrorText{0x8006, "the file exists"},
    ErrorText{0x8007, "no user"},
    ErrorText{0x8008, "only in the state BOOT"},
    ErrorText{0x8009, "not in the state BOOT"},
    ErrorText{0x800A, "no rights"},
    ErrorText{0x800B, "a program error of the slave"},
    ErrorText{0x800C, "the checksum is wrong"},
    ErrorText{0x800D, "the firmware does not fit the hardware"},
    ErrorText{0x800F, "there is nothing to read"},
};

}  // namespace

std::optional<Foe> read_foe(Bytes message) noexcept {
  if (message.size() < kFoeHeader) {
    return std::nullopt;
  }
  return Foe{static_cast<FoeCode>(message[0]), load<std::uint32_t>(message, kNumberAt), message.subspan(kFoeHeader)};
}

std::vector<std::uint8_t> write_foe(FoeCode code, std::uint32_t number, Bytes data) {
  std::vector<std::uint8_t> message(kFoeHeader + data.size());
  message[0] = static_cast<std::uint8_t>(code);
  store<std::uint32_t>(message, kNumberAt, number);
  std::copy(data.begin(), data.end(), message.begin() + kFoeHeader);
  return message;
}

std::vector<std::uint8_t> write_foe(FoeCode code, std::uint32_t number, std::string_view text) {
  return write_foe(code, number, Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::string_view foe_error_text(std::uint32_t code) noexcept {
  const auto* const found =
      std::find_if(kErrors.begin(), kErrors.end(), [code](const ErrorText& one) { return one.code == code; });
  return found == kErrors.end() ? "an unknown error" : found->text;
}

}  // namespace indurop::io::ethercat
