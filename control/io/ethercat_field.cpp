// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_field.h"

#include <algorithm>
#include <bit>

#include "control/io/ethercat/master/block.h"
#include "control/io/number.h"

namespace indurop::io {

namespace {

using Kind = EthercatField::Kind;

// How CoE numbers the types that are not unsigned.
Kind kind_of(std::uint8_t type) noexcept {
  switch (type) {
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

// The largest number of this many bits.
std::uint64_t all_ones(std::size_t bits) noexcept {
  return ~std::uint64_t{0} >> (64 - bits);
}

// Calls part(at, shift, done, bits) for each byte that holds some of the field: these bits of byte `at`, from `shift`
// on, are those of the value from `done` on.
template <class Part>
void for_each_byte(const EthercatField& field, Part part) noexcept {
  for (std::size_t done = 0; done < field.bits;) {
    const std::size_t shift = (field.bit + done) % 8;
    const std::size_t bits = std::min(8 - shift, field.bits - done);
    part((field.bit + done) / 8, shift, done, bits);
    done += bits;
  }
}

std::uint64_t load_bits(const EthercatField& field, std::span<const std::uint8_t> from) noexcept {
  std::uint64_t value = 0;
  for_each_byte(field, [&value, from](std::size_t at, std::size_t shift, std::size_t done, std::size_t bits) {
    value |= (std::uint64_t{from[at]} >> shift & all_ones(bits)) << done;
  });
  return value;
}

void store_bits(const EthercatField& field, std::uint64_t value, std::span<std::uint8_t> to) noexcept {
  for_each_byte(field, [value, to](std::size_t at, std::size_t shift, std::size_t done, std::size_t bits) {
    const std::uint64_t mask = all_ones(bits) << shift;
    to[at] = static_cast<std::uint8_t>((to[at] & ~mask) | (value >> done << shift & mask));
  });
}

}  // namespace

std::optional<EthercatField> find_field(const std::vector<ethercat::Pdo>& pdos, config::IoObject object) {
  const auto place = ethercat::find_block(pdos, {object.index, object.subindex});
  if (!place) {
    return std::nullopt;
  }
  const EthercatField field{place->bit, place->bits, kind_of(place->type)};
  return is_number(field) ? std::optional(field) : std::nullopt;
}

Number read_field(const EthercatField& field, std::span<const std::uint8_t> from) noexcept {
  const std::uint64_t bits = load_bits(field, from);
  if (field.kind == Kind::Real) {
    return field.bits == 32 ? static_cast<Number>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                            : static_cast<Number>(std::bit_cast<double>(bits));
  }
  // is_number() has seen that there are bits. NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
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
  bool fits = false;
  std::uint64_t bits = 0;
  if (field.kind == Kind::Signed) {
    std::int64_t whole = 0;
    fits = to_whole(number, whole);
    const auto high = static_cast<std::int64_t>(all_ones(field.bits) >> 1U);
    const std::int64_t limited = std::clamp(whole, -high - 1, high);
    fits = fits && limited == whole;
    bits = static_cast<std::uint64_t>(limited);
  } else {
    fits = to_whole(number, bits) && bits <= all_ones(field.bits);
    bits = std::min(bits, all_ones(field.bits));
  }
  store_bits(field, bits, to);
  return fits;
}

}  // namespace indurop::io
