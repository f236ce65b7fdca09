// SPDX-License-Identifier: Apache-2.0
// A request and its reply as plain data: nothing here knows the library that speaks HTTP.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.h"

namespace indurop::serve {

enum class Method { Get, Post, Other };

// What a request asks for: nothing that is anybody's, to look, or to change something.
enum class Right { Open, Read, Write };

// What a client may do. On this machine those that nobody knows may look.
enum class Role { Unknown, Reader, Writer };

// Who asks, as far as its certificate or token says.
struct Client {
  std::string name;  // empty: nobody known
  Role role = Role::Unknown;
  std::string refusal;  // why what it showed does not count; empty: it counts, or there was nothing
};

struct Request {
  Method method = Method::Get;
  std::string path;  // decoded
  std::vector<std::pair<std::string, std::string>> query;
  std::string host;
  std::string origin;         // empty: none was sent
  std::string fetch_site;     // Sec-Fetch-Site
  std::string authorization;  // whole header
  std::string subprotocols;   // Sec-WebSocket-Protocol
  std::string subprotocol;    // the one that is spoken; empty: HTTP
  std::string content_type;
  Client certificate;  // what the client's certificate says
  Client client;       // what certificate and token say together; known once it was admitted
  std::string from;    // address
  std::string body;
  bool has_body = false;
  bool stream = false;  // asks for a WebSocket
  bool close = false;   // wants no further request on this connection
};

struct Reply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::string allow;              // header Allow, of 405
  bool immutable = false;         // may be kept by browsers for a year
  bool close = false;             // end the connection afterwards
  std::string wrong_credentials;  // why the token or certificate that was shown does not count; empty: it does
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

// The word for programs that belongs to a status: "not_found".
std::string_view word_of(int status) noexcept;

Reply json_reply(const base::Json& value);
// {"error", "message", "details"}; `details` is left out if there are none.
Reply refusal(int status, std::string message, const std::vector<std::string>& details = {});

// First value of a name; nothing if there is none.
std::optional<std::string> query_value(const Request& request, std::string_view name);

}  // namespace indurop::serve
