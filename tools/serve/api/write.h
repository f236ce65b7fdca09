// SPDX-License-Identifier: Apache-2.0
// One write of a client, from the request body to the entry in the audit log. The store is open for writing only during
// this write.

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "store/vars/store.h"
#include "tools/cli/command/verb.h"
#include "tools/serve/api/api.h"
#include "tools/serve/api/router.h"

namespace indurop::serve {

class Write {
 public:
  Write(Api& api, const Call& call, std::string action);
  Write(const Write&) = delete;
  Write& operator=(const Write&) = delete;

  tools::Context& context() noexcept { return context_; }
  // The last message for the client.
  [[nodiscard]] std::string message() const { return messages_.empty() ? std::string() : messages_.back(); }

  // Opens the board's store for writing; with `running` the node must be running.
  Result<vars::Store, Reply> open(bool running);
  // Returns who writes, from where, and why.
  [[nodiscard]] operate::Who who() const { return {entry_.who, entry_.from, entry_.reason}; }
  // Sets what is logged.
  void about(std::string what, std::string reason);
  Reply failed(int code, std::string why);
  // Fails for all these reasons (at least one); the first one is logged.
  Reply failed(int code, const std::vector<std::string>& all);
  Reply failed_with(int exit_code);
  // Fails because store/operate/ refused it.
  Reply failed(const operate::Refusal& refusal);
  // To be called before anything is changed: a write that cannot be logged is not done.
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
