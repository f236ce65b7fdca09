// SPDX-License-Identifier: Apache-2.0
// The list of users of a plant as boards keep it and pass it on. It is signed by the one who sent it to the plant, so a
// board that was off takes it from any other board. No network, no files.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::deploy {

struct UserList {
  std::string plant;
  std::uint64_t serial = 0;  // each list that is sent to the plant has a higher one
  std::string users;         // XML (config/users_reader.h), without passwords
  std::string signature;     // of signed_text(), like that of a Command; empty: unsigned
};

// Returns the serial of the list that a desk sends at this time, where `highest` is that of all boards which it has
// found. It is the time in seconds since 1970, so that lists which are sent one after the other to different boards,
// while others are off, have this order; a desk whose clock is behind adds one to `highest`.
std::uint64_t next_serial(std::uint64_t highest, std::int64_t wall_ns) noexcept;

std::string text_of(const UserList& list);
// Returns nothing if the text is not a list of users.
std::optional<UserList> read_user_list(std::string_view text);
// Returns the text that is signed.
std::string signed_text(const UserList& list);

// Which of the lists of a plant one is. Two desks that send lists at the same time may use one serial: the digest then
// decides, so that all boards agree.
struct UserListId {
  std::uint64_t serial = 0;
  std::string digest;
  auto operator<=>(const UserListId&) const = default;  // NOLINT(modernize-use-nullptr)
};
UserListId id_of(const UserList& list);
std::string text_of(const UserListId& id);
// Returns nothing if the text is not that of an id.
std::optional<UserListId> read_user_list_id(std::string_view text);

}  // namespace indurop::deploy
