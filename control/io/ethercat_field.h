// SPDX-License-Identifier: Apache-2.0
// One object in the process data of an EtherCAT slave: where its bits are, and the number they are. Real-time safe.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "config/model/io_config.h"
#include "control/io/ethercat/sii.h"
#include "control/io/sample.h"

namespace indurop::io {

struct EthercatField {
  enum class Kind : std::uint8_t { Unsigned, Signed, Real };
  std::size_t bit = 0;  // the first one, in the bytes of its direction
  std::size_t bits = 0;
  Kind kind = Kind::Unsigned;
};

// Finds an object in the mapping; nothing if it is not there, or is no number of at most 64 bits.
std::optional<EthercatField> find_field(const std::vector<ethercat::Pdo>& pdos, config::IoObject object);

Number read_field(const EthercatField& field, std::span<const std::uint8_t> from) noexcept;
// Returns false if the field cannot hold the number: it has the nearest one.
bool write_field(const EthercatField& field, Number number, std::span<std::uint8_t> to) noexcept;

}  // namespace indurop::io
