// SPDX-License-Identifier: Apache-2.0
// Converts numbers to 16-bit registers and back: types, order of words and bytes. Pure functions, real-time safe.

#pragma once

#include <cstdint>
#include <span>

#include "config/model/io_config.h"
#include "control/io/sample.h"

namespace indurop::io {

using config::WireType;

// "abcd" is the order of Modbus: high word first, high byte of each word first.
struct WireForm {
  WireType type = WireType::UInt16;
  bool swap_words = false;
  bool swap_bytes = false;
};

inline WireForm form_of(const config::IoPoint& point) noexcept {
  return {point.type, point.swap_words, point.swap_bytes};
}

// `registers` has config::registers_of(form.type) words.
Number decode(const WireForm& form, std::span<const std::uint16_t> registers) noexcept;
// Returns the point's value in its registers: the number, or one bit.
Number value_in(const config::IoPoint& point, std::span<const std::uint16_t> registers) noexcept;
// Returns false if the number does not fit; the nearest possible value was written then. Nothing is written for a NaN
// that the wire's type cannot represent.
bool encode(const WireForm& form, Number value, std::span<std::uint16_t> registers) noexcept;

}  // namespace indurop::io
