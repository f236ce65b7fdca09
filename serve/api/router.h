// SPDX-License-Identifier: Apache-2.0
// Which answer belongs to a path. The paths are those of serve/openapi.json, which a test compares with this.

#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "serve/door/request.h"

namespace indurop::deploy {
struct LinkSettings;
}
namespace indurop::tools {
class PlantWatch;
class PlcPictures;
}  // namespace indurop::tools

namespace indurop::serve {

class Api;

class Boards;

// A request whose path was understood.
struct Call {
  const Request* request = nullptr;
  Boards* boards = nullptr;                              // of the thread that answers
  tools::PlantWatch* plant = nullptr;                    // of Pace::Plant
  const deploy::LinkSettings* link = nullptr;            // of Pace::PlantOrders
  tools::PlcPictures* plc = nullptr;                     // of Pace::Plc
  std::string who;                                       // as the gate knows the client
  std::map<std::string, std::string, std::less<>> part;  // "board", "module", "name"
};

// Which thread answers: the door's; one that may read files; one that may wait for a node; one of those that wait for
// something to happen; one for what must not wait for the others; the one that hears other boards; the one that changes
// what they run; the one that knows the PLC program. Files of the page and streams have no answer of their own.
enum class Pace { Quick, Files, Orders, Wait, Holds, Plant, PlantOrders, Plc, Page, Stream };

using Answer = Reply (*)(Api& api, const Call& call);

// How a question about a board of another host is answered.
struct Remote {
  bool possible = false;    // false: by a server on that host only
  Answer answer = nullptr;  // asks or orders through the plant; null: the usual answer, from what its agent reported
};
inline constexpr Remote kHereOnly{};
inline constexpr Remote kAlike{true, nullptr};
constexpr Remote through(Answer answer) noexcept {
  return {true, answer};
}

struct Route {
  Method method;
  std::string_view pattern;  // "/api/v1/boards/{board}/set"; a last part "{file...}" is every path
  Right right;
  Pace pace;
  Answer answer;
  Remote remote;
  std::string_view protocol = "";  // subprotocol of a WebSocket; empty: HTTP
};

// Everything that can be asked of the server. What is not in here is not there: no protocol, no path, no method.
std::span<const Route> all_routes();

struct Match {
  const Route* route = nullptr;  // null: see `other_method`
  bool other_method = false;     // the path is known, with another method
  Call call;
};
Match match_route(std::span<const Route> routes, const Request& request);
// What a client needs to be allowed for this request; of what is not there as much as if it were.
Right right_of(std::span<const Route> routes, const Request& request);
// The first of the subprotocols a client asks for that is in the table; empty: none.
std::string choose_subprotocol(std::span<const Route> routes, const Request& request);

// The parts of a path that a pattern names; nothing if it does not fit.
std::optional<std::map<std::string, std::string, std::less<>>> match_path(std::string_view pattern,
                                                                          std::string_view path);

}  // namespace indurop::serve
