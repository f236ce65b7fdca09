// SPDX-License-Identifier: Apache-2.0
// The GUID by which DDS identifies a participant, reader or writer in the whole network, and the participant of a
// matched endpoint.

#pragma once

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "network/dds/entity.h"

namespace indurop::dds {

using Guid = std::array<std::uint8_t, 16>;

inline Guid guid_of(const dds_guid_t& guid) noexcept {
  Guid out{};
  std::copy(std::begin(guid.v), std::end(guid.v), out.begin());
  return out;
}
Guid guid_of(Handle entity) noexcept;

// Returns the participant of a publication that `reader` is matched with. Empty: it has already gone.
std::optional<Guid> participant_of(Handle reader, InstanceHandle publication);
// Returns the QosChoice::mark of that publication's writer, or what another program has put there (USER_DATA). Empty:
// none, or it has already gone.
std::string mark_of(Handle reader, InstanceHandle publication);
// Returns true if that publication's writer was made with QosChoice::mark `mark`; false also if it has already gone.
bool is_marked(Handle reader, InstanceHandle publication, std::string_view mark);
// Returns true if the GUID of a participant begins with `subject`, the SHA-256 of its certificate's subject as
// hexadecimal digits. DDS Security verifies this number when it admits the participant.
bool is_numbered_by(const Guid& participant, std::string_view subject) noexcept;
// Returns the number of readers that `writer` is matched with. Empty: the writer is gone.
std::optional<std::uint32_t> readers_of(Handle writer);
// Returns true if `participant` has one of these readers.
bool is_read_by(Handle writer, const Guid& participant);

}  // namespace indurop::dds
