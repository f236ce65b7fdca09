// SPDX-License-Identifier: Apache-2.0
// indurop-serve put together: gate, door, answers, page.

#pragma once

#include <memory>

#include "serve/api/api.h"
#include "serve/door/door.h"
#include "tools/command/serve_options.h"

namespace indurop::serve {

class Server final : public House {
 public:
  Server(tools::ServeOptions options, GateSettings gate, std::string version);

  // Serves until a signal ends it. Returns the exit code.
  int run();

  std::optional<Reply> refuse(const Request& request) override { return gate_.refuse(request); }
  std::optional<Reply> answer(const Request& request, Ticket ticket) override;
  std::unique_ptr<Visitor> receive(const Request& request, Line& line) override;

 private:
  tools::ServeOptions options_;
  Gate gate_;
  Api api_;
  std::unique_ptr<Door> door_;
};

}  // namespace indurop::serve
