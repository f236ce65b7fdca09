// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/user_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.h"
#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

constexpr std::string_view kMark = "indurop users\n";

}  // namespace

std::uint64_t next_serial(std::uint64_t highest, std::int64_t wall_ns) noexcept {
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  return std::max(highest + 1, static_cast<std::uint64_t>(std::max<std::int64_t>(wall_ns, 0) / kSecondNs));
}

std::string text_of(const UserList& list) {
  return fmt::format("{}{}\n{}\n{}\n{}{}", kMark, list.plant, list.serial, list.signature.size(), list.signature,
                     list.users);
}

std::optional<UserList> read_user_list(std::string_view text) {
  if (!text.starts_with(kMark)) {
    return std::nullopt;
  }
  text.remove_prefix(kMark.size());
  UserList list;
  list.plant = base::take_line(text);
  const auto serial = base::whole_number(base::take_line(text));
  const auto size = base::whole_number(base::take_line(text));
  if (!serial || !size || *size > text.size()) {
    return std::nullopt;
  }
  list.serial = *serial;
  list.signature = text.substr(0, *size);
  list.users = text.substr(*size);
  return list;
}

std::string signed_text(const UserList& list) {
  return fmt::format("indurop list of users\n{}\n{}\n{}", list.plant, list.serial, list.users);
}

UserListId id_of(const UserList& list) {
  return {list.serial, keys::digest_of(list.users)};
}

std::string text_of(const UserListId& id) {
  return fmt::format("{}-{}", id.serial, id.digest);
}

std::optional<UserListId> read_user_list_id(std::string_view text) {
  const std::size_t dash = std::min(text.find('-'), text.size());
  const auto serial = base::whole_number(text.substr(0, dash));
  const std::string_view digest = text.substr(std::min(dash + 1, text.size()));
  return serial && keys::is_digest(digest) ? std::optional(UserListId{*serial, std::string(digest)}) : std::nullopt;
}

}  // namespace indurop::deploy
