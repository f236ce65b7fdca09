// SPDX-License-Identifier: Apache-2.0
// A request and its reply as plain data, independent of the HTTP library.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/json.h"

namespace indurop::serve {

enum class Method { Get, Post, Other };

// The rights of a client. Each role includes those before it. On this machine unidentified clients may look.
enum class Role { Unknown, Look, Operate, Tune, Program, Administer };
std::string_view word_of(Role role) noexcept;

// The client, as identified by its session, token or certificate.
struct Client {
  std::string name;  // empty: not identified
  Role role = Role::Unknown;
  std::string refusal;  // why its token or certificate is rejected; empty: it is accepted, or there was none
  std::vector<std::string> boards;     // patterns over boards that it may change; none: all
  std::vector<std::string> variables;  // patterns over full names of variables that it may change; none: all
};

// What a client must have for a request.
struct Needed {
  Role role = Role::Unknown;  // Unknown: anyone
  std::string board;          // the board that the path names; empty: none
};

struct Request {
  Method method = Method::Get;
  std::string path;  // decoded
  std::vector<std::pair<std::string, std::string>> query;
  std::string host;
  std::string origin;         // empty: none was sent
  std::string fetch_site;     // Sec-Fetch-Site
  std::string authorization;  // the whole header
  std::string subprotocols;   // Sec-WebSocket-Protocol
  std::string subprotocol;    // the one in use; empty: HTTP
  std::string content_type;
  std::string certificate_pem;  // that the client presented; empty: none
  Client certificate;           // the client according to it
  Client client;                // the client according to certificate and token
  std::string from;             // address
  std::string body;
  bool has_body = false;
  bool stream = false;      // requests a WebSocket
  bool background = false;  // no user caused it, so it does not count as use of a session
  bool close = false;       // requests to close the connection after the reply
};

struct Reply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::string allow;              // header Allow, of 405
  bool immutable = false;         // browsers may cache it for a year
  bool close = false;             // end the connection afterwards
  std::string wrong_credentials;  // why the token or certificate is rejected; empty: it is accepted
  std::string lacks_right;        // why a known client may not do this; empty: it may
};

namespace status {
inline constexpr int kOk = 200;
inline constexpr int kBadRequest = 400;
inline constexpr int kUnauthorized = 401;
inline constexpr int kForbidden = 403;
inline constexpr int kNotFound = 404;
inline constexpr int kMethodNotAllowed = 405;
inline constexpr int kTimeout = 408;
inline constexpr int kConflict = 409;
inline constexpr int kTooLarge = 413;
inline constexpr int kNotJson = 415;
inline constexpr int kMisdirected = 421;
inline constexpr int kWrongValue = 422;
inline constexpr int kLocked = 423;
inline constexpr int kHeadTooLarge = 431;
inline constexpr int kFailed = 500;
inline constexpr int kUnavailable = 503;
inline constexpr int kNoAnswer = 504;
}  // namespace status

// Returns the machine-readable word for a status: "not_found".
std::string_view word_of(int status) noexcept;

Reply json_reply(const base::Json& value);
// Returns a refusal with the body {"error", "message", "details"}; without `details` if there are none.
Reply refusal(int status, std::string message, const std::vector<std::string>& details = {});

// Returns the first value of a name in the query; nothing if there is none.
std::optional<std::string> query_value(const Request& request, std::string_view name);

}  // namespace indurop::serve
