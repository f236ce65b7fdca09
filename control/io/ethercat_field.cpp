// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_field.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "control/io/number.h"

namespace indurop::io {

namespace {

using Kind = EthercatField::Kind;

// How CoE numbers the types that are not unsigned.
Kind kind_of(const ethercat::PdoEntry& entry) noexcept {
  switch (entry.type) {
    case 0x02:  // INTEGER8
    case 0x03:
    case 0x04:
    case 0x10:  // INTEGER24
    case 0x12:  // INTEGER40 to INTEGER64
    case 0x13:
    case 0x14:
    case 0x15:
      return Kind::Signed;
    case 0x08:  // REAL32
    case 0x11:  // REAL64
      return Kind::Real;
    default:
      return Kind::Unsigned;
  }
}

bool is_number(const EthercatField& field) noexcept {
  const bool is_real = field.bits == 32 || field.bits == 64;
  return field.bits > 0 && field.bits <= 64 && (field.kind != Kind::Real || is_real);
}

std::uint64_t load_bits(const EthercatField& field, std::span<const std::uint8_t> from) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < field.bits; ++i) {
    const std::size_t at = field.bit + i;
    value |= std::uint64_t{static_cast<unsigned>(from[at / 8]) >> (at % 8) & 1U} << i;
  }
  return value;
}

void store_bits(const EthercatField& field, std::uint64_t value, std::span<std::uint8_t> to) noexcept {
  for (std::size_t i = 0; i < field.bits; ++i) {
    const std::size_t at = field.bit + i;
    const unsigned mask = 1U << (at % 8);
    to[at / 8] = static_cast<std::uint8_t>((value >> i & 1U) != 0 ? to[at / 8] | mask : to[at / 8] & ~mask);
  }
}

// The largest number of this many bits.
std::uint64_t all_ones(std::size_t bits) noexcept {
  return ~std::uint64_t{0} >> (64 - bits);
}

}  // namespace

std::optional<EthercatField> find_field(const std::vector<ethercat::Pdo>& pdos, config::IoObject object) {
  // The bytes of SyncManagers follow each other in their order, and in each of them its PDOs.
  std::size_t start = 0;
  for (std::uint8_t manager = 0; manager < 0xFF; ++manager) {
    std::size_t bit = start;
    for (const ethercat::Pdo& pdo : pdos) {
      for (const ethercat::PdoEntry& entry : pdo.entries) {
        if (pdo.sync_manager != manager) {
          continue;
        }
        const EthercatField field{bit, entry.bits, kind_of(entry)};
        if (entry.index == object.index && entry.subindex == object.subindex) {
          return is_number(field) ? std::optional(field) : std::nullopt;
        }
        bit += entry.bits;
      }
    }
    start = (bit + 7) / 8 * 8;
  }
  return std::nullopt;
}

Number read_field(const EthercatField& field, std::span<const std::uint8_t> from) noexcept {
  const std::uint64_t bits = load_bits(field, from);
  if (field.kind == Kind::Real) {
    return field.bits == 32 ? static_cast<Number>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                            : static_cast<Number>(std::bit_cast<double>(bits));
  }
  const bool is_negative = field.kind == Kind::Signed && (bits >> (field.bits - 1) & 1U) != 0;
  return is_negative ? static_cast<Number>(static_cast<std::int64_t>(bits | ~all_ones(field.bits)))
                     : static_cast<Number>(bits);
}

bool write_field(const EthercatField& field, Number number, std::span<std::uint8_t> to) noexcept {
  if (field.kind == Kind::Real) {
    float small = 0;
    double large = 0;
    const bool fits = field.bits == 32 ? to_real(number, small) : to_real(number, large);
    store_bits(field, field.bits == 32 ? std::bit_cast<std::uint32_t>(small) : std::bit_cast<std::uint64_t>(large), to);
    return fits;
  }
  const std::uint64_t largest = all_ones(field.bits) >> (field.kind == Kind::Signed ? 1U : 0U);
  const Number high = static_cast<Number>(largest);
  const Number low = field.kind == Kind::Signed ? -high - 1 : Number{0};
  const Number rounded = std::nearbyint(number);
  const Number limited = std::clamp(rounded, low, high);
  store_bits(field,
             limited < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(limited))
                         : static_cast<std::uint64_t>(limited),
             to);
  return limited == rounded;
}

}  // namespace indurop::io
