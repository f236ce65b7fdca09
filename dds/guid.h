// SPDX-License-Identifier: Apache-2.0
// The number by which DDS knows a participant, reader or writer in the whole network, and who is behind a match.

#pragma once

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

#include "dds/entity.h"

namespace indurop::dds {

using Guid = std::array<std::uint8_t, 16>;

inline Guid guid_of(const dds_guid_t& guid) noexcept {
  Guid out{};
  std::copy(std::begin(guid.v), std::end(guid.v), out.begin());
  return out;
}
Guid guid_of(Handle entity) noexcept;

// The participant behind a publication that `reader` is matched with. Empty: it is gone already.
std::optional<Guid> participant_of(Handle reader, InstanceHandle publication);
// Was that publication's writer made with QosChoice::mark `mark`? False: also if it is gone already.
bool is_marked(Handle reader, InstanceHandle publication, std::string_view mark);
// A participant of DDS Security has a number that begins with the SHA-256 of its certificate's subject, and who lets it
// in verifies that. `subject`: that digest as hexadecimal digits.
bool is_numbered_by(const Guid& participant, std::string_view subject) noexcept;
// Readers that `writer` is matched with. Empty: the writer is gone.
std::optional<std::uint32_t> readers_of(Handle writer);
// Has `participant` one of them?
bool is_read_by(Handle writer, const Guid& participant);

}  // namespace indurop::dds
