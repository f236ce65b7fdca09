// SPDX-License-Identifier: Apache-2.0
// Requests to `indurop serve`.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/json.h"
#include "core/base/problem.h"
#include "doors/mqtt/serve/address.h"

namespace indurop::mqtt {

// How the server is reached.
struct ServeAccess {
  Address address;
  std::filesystem::path ca;  // of its certificate; empty: the authorities of the system
};

struct HttpReply {
  int status = 0;
  std::string body;
};

// The lines of a request up to the empty one; `more` are further lines, each with its end. An empty token: none.
std::string request_head(const ServeAccess& access, std::string_view method, std::string_view path,
                         std::string_view token, std::string_view more);

// Sends one request on a connection of its own; a body is JSON. May take some seconds. Errors: no answer, or one that
// is not HTTP.
Result<HttpReply, base::Problem> ask(const ServeAccess& access, std::string_view method, std::string_view path,
                                     std::string_view token, std::string_view body);

// A name as part of a path.
std::string path_part(std::string_view name);

}  // namespace indurop::mqtt
