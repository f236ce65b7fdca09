// SPDX-License-Identifier: Apache-2.0
// One connection that speaks HTTP, request after request: takes headers and body in, gives the reply out in pieces.

#pragma once

#include <libwebsockets.h>

#include <cstddef>
#include <optional>

#include "serve/door/house.h"

namespace indurop::serve {

// The request's headers, as libwebsockets has them.
Request read_request(lws* wsi, std::string path);
// Length of the body that is announced, or why it cannot be taken. `unknown`: none was announced.
struct BodyLength {
  std::size_t bytes = 0;
  bool unknown = false;
  std::optional<Reply> refusal;
};
BodyLength read_length(lws* wsi);

class Exchange {
 public:
  Exchange(lws* wsi, Ticket ticket, Request request) : wsi_(wsi), ticket_(ticket), request_(std::move(request)) {}

  [[nodiscard]] lws* wsi() const noexcept { return wsi_; }
  [[nodiscard]] Ticket ticket() const noexcept { return ticket_; }
  Request& request() noexcept { return request_; }
  void expect_body() noexcept { waits_for_body_ = true; }
  void body_is_here() noexcept { waits_for_body_ = false; }
  [[nodiscard]] bool waits_for_body() const noexcept { return waits_for_body_; }

  // Results as a callback of libwebsockets returns them: other than 0 ends the connection.
  // The head goes out at once, the body when the client can take it.
  int begin(Reply reply);
  int go_on();
  // Head and body at once, for a client that is not listened to any more.
  static int refuse(lws* wsi, const Reply& reply);

 private:
  lws* wsi_;
  Ticket ticket_;
  Request request_;
  Reply reply_;
  std::size_t sent_ = 0;
  bool replying_ = false;
  bool waits_for_body_ = false;
};

}  // namespace indurop::serve
