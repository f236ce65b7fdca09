// SPDX-License-Identifier: Apache-2.0
// The exchange of a module on a board by its agent: the text that a client sends, and the one that the agent answers.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "store/operate/reload.h"

namespace indurop::operate {

struct RemoteReload {
  bool back = false;       // to the previous version; there is no file
  std::string digest;      // SHA-256 of the new file, which the agent fetches from the client
  std::uint64_t size = 0;  // of the file
  ReloadRequest request;   // `file` is of no meaning
};
std::string text_of(const RemoteReload& reload);
// Returns nothing if the text is not such an order.
std::optional<RemoteReload> parse_remote_reload(std::string_view text);

struct RemoteReloadReply {
  // Returned: the new version ran, and the previous one runs again.
  enum class Result { Done, Unchanged, Refused, Failed, Returned };
  Result result = Result::Failed;
  ReloadReport report;
};
std::string text_of(const RemoteReloadReply& reply);
std::optional<RemoteReloadReply> parse_remote_reload_reply(std::string_view text);

}  // namespace indurop::operate
