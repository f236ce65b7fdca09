// SPDX-License-Identifier: Apache-2.0
// One write of a client, from its body to the note in the audit log. The store is opened to write for that moment only.

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "operate/refusal.h"
#include "operate/who.h"
#include "serve/api/api.h"
#include "serve/api/router.h"
#include "tools/command/verb.h"
#include "vars/store.h"

namespace indurop::serve {

class Write {
 public:
  Write(Api& api, const Call& call, std::string action);
  Write(const Write&) = delete;
  Write& operator=(const Write&) = delete;

  tools::Context& context() noexcept { return context_; }
  // The last one for the client.
  [[nodiscard]] std::string message() const { return messages_.empty() ? std::string() : messages_.back(); }

  // Opens the board's store to write; it has to run if `running`.
  Result<vars::Store, Reply> open(bool running);
  // Who writes, and why.
  [[nodiscard]] operate::Who who() const { return {entry_.who, entry_.from, entry_.reason}; }
  // What is noted.
  void about(std::string what, std::string reason);
  Reply failed(int code, std::string why);
  // For all these reasons, at least one; the first one is noted.
  Reply failed(int code, const std::vector<std::string>& all);
  Reply failed_with(int exit_code);
  // What operate/ refused.
  Reply failed(const operate::Refusal& refusal);
  // Before anything is changed: without a note nothing is written.
  std::optional<Reply> begin();
  Reply done(const base::Json& body);

 private:
  void note_failure(const std::string& why);

  Api* api_;
  AuditEntry entry_;
  std::vector<std::string> messages_;
  tools::Context context_;
};

}  // namespace indurop::serve
