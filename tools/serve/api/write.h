// SPDX-License-Identifier: Apache-2.0
// One write of a client, from the request body to the entry in the audit log.

#pragma once

#include <optional>
#include <string>

#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "tools/serve/api/api.h"
#include "tools/serve/api/router.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve {

class Write final : public ChangeNote {
 public:
  Write(Api& api, const Call& call, std::string action);

  // Returns who writes, from where, and why.
  [[nodiscard]] operate::Who who() const override { return {entry_.who, entry_.from, entry_.reason}; }
  // Sets what is logged.
  void about(std::string what, std::string reason);
  Reply failed(int code, std::string why);
  // Fails for all its reasons; the first one is logged.
  Reply failed(const Refused& refused);
  // Fails because store/operate/ refused it.
  Reply failed(const operate::Refusal& refusal);
  // A write is not done if its client has lost the right while the request waited, or if it cannot be logged, except
  // for a stop.
  std::optional<Refused> begin(const Affected& affected) override;
  // `body` says of a stop that it could not be logged.
  Reply done(base::Json body);

 private:
  void note_failure(const std::string& why);

  Api* api_;
  Request request_;  // without its body
  AuditEntry entry_;
  std::string unlogged_;  // why its begin could not be logged
};

}  // namespace indurop::serve
