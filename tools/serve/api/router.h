// SPDX-License-Identifier: Apache-2.0
// Maps a path to its answer. The paths are those of tools/serve/openapi.json; a test compares the two.

#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tools/serve/door/request.h"

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

// A request whose path was recognized.
struct Call {
  const Request* request = nullptr;
  Boards* boards = nullptr;                              // those of the thread that answers
  tools::PlantWatch* plant = nullptr;                    // for Pace::Plant
  const deploy::LinkSettings* link = nullptr;            // for Pace::PlantOrders
  tools::PlcPictures* plc = nullptr;                     // for Pace::Plc
  std::string who;                                       // name of the client, as the gate knows it
  std::map<std::string, std::string, std::less<>> part;  // "board", "module", "name"
};

// The thread that answers: the door's; one that may read files; one that verifies passwords; one that may wait for a
// node; one of those that wait for an event; one for requests that must not wait for the others; one that receives from
// remote boards; one that changes what they run; one that has the PLC program; one that reads histories; one that calls
// shared functions; one that waits for replays. Files of the page and streams have no answer of their own.
enum class Pace {
  Quick,
  Files,
  SignIn,
  Orders,
  Wait,
  Holds,
  Plant,
  PlantOrders,
  Plc,
  History,
  Calls,
  Replays,
  Page,
  Stream
};

using Answer = Reply (*)(Api& api, const Call& call);

// How a request about a board of another host is answered: only by a server on that host; from what the board's agent
// reported; by a request or command to that agent; or by this server, as for a local board.
enum class Remote { No, Reported, Asked, Same };

struct Route {
  Method method;
  std::string_view pattern;  // "/api/v1/boards/{board}/set"; a last part "{file...}" matches any path
  Role role;                 // that a client needs; Unknown: none
  Pace pace;
  Answer answer;
  Remote remote;
  std::string_view protocol = "";  // subprotocol of a WebSocket; empty: HTTP
};

// All routes of the server. Anything else does not exist: no protocol, no path, no method.
std::span<const Route> all_routes();

struct Match {
  const Route* route = nullptr;  // null: see `other_method`
  bool other_method = false;     // the path is known, with another method
  Call call;
};
Match match_route(std::span<const Route> routes, const Request& request);
// Returns what a client needs for this request; for a path that does not exist at least as much as to look or operate.
Needed needed_for(std::span<const Route> routes, const Request& request);
// Returns the first of the subprotocols requested by the client that is in the table; empty: none.
std::string choose_subprotocol(std::span<const Route> routes, const Request& request);

// Returns the values of the named parts of a pattern; nothing if the path does not match it.
std::optional<std::map<std::string, std::string, std::less<>>> match_path(std::string_view pattern,
                                                                          std::string_view path);

}  // namespace indurop::serve
