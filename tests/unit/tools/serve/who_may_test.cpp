// SPDX-License-Identifier: Apache-2.0
// Who may do what: every line of the table of all that can be asked, by everybody who may ask, in every way the server
// can be started. What is expected is worked out here from the method and the path alone, not from the table.

#include <gtest/gtest.h>

#include <array>

#include "tools/serve/api/router.h"
#include "tools/serve/door/gate.h"
#include "tools/serve/door/house.h"

namespace indurop::serve {
namespace {

constexpr const char* kWriteToken = "write-token-abcdefghijkl";
constexpr const char* kReadToken = "read-token-abcdefghijklm";

// Who asks.
struct Asker {
  const char* what = "";
  const char* token = "";
  Client certificate;
  bool known = false;   // to the server
  bool writes = false;  // if the server lets anybody write
  bool wrong = false;   // showed something that does not count
};

const std::array kAskers{
    Asker{"nobody", "", {}, false, false, false},
    Asker{"wrong token", "wrong-token-abcdefghijkl", {}, false, false, true},
    Asker{"beginning of the token", "write-token-abcdefghijk", {}, false, false, true},
    Asker{"read token", kReadToken, {}, true, false, false},
    Asker{"write token", kWriteToken, {}, true, true, false},
    Asker{"certificate of a tool", "", {"panel", Role::Reader, {}}, true, false, false},
    Asker{"certificate of a viewer", "", {"viewer", Role::Reader, {}}, true, false, false},
    Asker{"certificate of a board", "", {"drive", Role::Reader, {}}, true, false, false},
    Asker{"certificate of a deployer", "", {"deployer", Role::Writer, {}}, true, true, false},
    Asker{"revoked certificate", "", {"deployer", Role::Unknown, "it was revoked"}, false, false, true},
    Asker{"wrong token with a deployer's certificate",
          "wrong-token-abcdefghijkl",
          {"deployer", Role::Writer, {}},
          false,
          false,
          true},
};

Request request_for(const Route& route, const Asker& asker, bool header) {
  Request request;
  request.method = route.method;
  request.path = std::string(route.pattern);
  if (route.pattern.ends_with("...}")) {
    request.path = route.protocol.empty() ? "/assets/page.js" : "/";
  }
  request.host = "localhost:8080";
  request.stream = !route.protocol.empty();
  request.subprotocols = std::string(route.protocol);
  request.subprotocol = choose_subprotocol(all_routes(), request);
  request.certificate = asker.certificate;
  if (*asker.token != '\0' && request.stream && !header) {
    request.subprotocols += std::string(", indurop.token.") + asker.token;
  } else if (*asker.token != '\0') {
    request.authorization = std::string("Bearer ") + asker.token;
  }
  return request;
}

GateSettings settings_of(bool loopback, bool write) {
  GateSettings settings;
  settings.loopback = loopback;
  settings.tls = !loopback;
  settings.write = write;
  settings.hosts = {"localhost", "127.0.0.1", "::1"};
  settings.tokens = {{"operator", kWriteToken, Role::Writer}, {"desk", kReadToken, Role::Reader}};
  return settings;
}

int expected(const Request& request, const Asker& asker, const GateSettings& settings) {
  const bool page = !request.stream && !request.path.starts_with("/api/");
  if (page) {
    return 0;
  }
  if (asker.wrong || (!asker.known && !settings.loopback)) {
    return status::kUnauthorized;
  }
  if (request.method == Method::Get || (settings.write && asker.writes)) {
    return 0;
  }
  return settings.write && !asker.known ? status::kUnauthorized : status::kForbidden;
}

int code_of_reply(const std::optional<Reply>& reply) {
  return reply ? reply->status : 0;
}

template <class Check>
void walk(const Check& check) {
  for (const bool loopback : {true, false}) {
    for (const bool write : {true, false}) {
      const GateSettings settings = settings_of(loopback, write);
      for (const Route& route : all_routes()) {
        for (const Asker& asker : kAskers) {
          for (const bool header : {true, false}) {
            SCOPED_TRACE(std::string(asker.what) + (loopback ? ", here, " : ", elsewhere, ") +
                         (write ? "--write, " : "") + std::string(route.protocol) + " " +
                         (route.method == Method::Post ? "POST " : "GET ") + std::string(route.pattern));
            check(settings, request_for(route, asker, header), asker);
          }
        }
      }
    }
  }
}

int answer_of(const GateSettings& settings, const Request& request) {
  return code_of_reply(Gate(settings).refuse(request, right_of(all_routes(), request)));
}

TEST(WhoMay, Is_the_same_for_every_line_of_the_table) {
  walk([](const GateSettings& settings, const Request& request, const Asker& asker) {
    EXPECT_EQ(answer_of(settings, request), expected(request, asker, settings));
  });
}

TEST(WhoMay, Nothing_is_answered_under_another_name_or_to_another_page) {
  walk([](const GateSettings& settings, Request request, const Asker& /*asker*/) {
    for (const char* host :
         {"", "evil.com", "localhost:evil.com", "localhost.evil.com", "evil.com:8080", "[::1", "[::1]8080"}) {
      request.host = host;
      EXPECT_EQ(answer_of(settings, request), status::kMisdirected) << host;
    }
    request.host = "LOCALHOST:8080";
    for (const char* origin :
         {"http://evil.com", "null", "http://localhost:8081", "file://", "http://localhost:8080.evil.com"}) {
      request.origin = origin;
      EXPECT_EQ(answer_of(settings, request), status::kForbidden) << origin;
    }
  });
}

TEST(WhoMay, What_is_not_in_the_table_asks_for_no_less) {
  const GateSettings settings = settings_of(false, true);
  for (const char* path : {"/api/", "/api/v1", "/api/v1/nothing", "/api/v2/boards", "/api/v1/stream"}) {
    for (const Method method : {Method::Get, Method::Post}) {
      Request request = request_for({method, path, Right::Open, Pace::Quick, nullptr, Remote::No}, kAskers[0], true);
      EXPECT_EQ(answer_of(settings, request), status::kUnauthorized) << path;
    }
  }
}

TEST(WhoMay, Only_these_subprotocols_are_spoken) {
  Request request;
  for (const char* name : {"listener", "http", "", "raw", "indurop.v1x", "INDUROP.V1", "lws-mirror-protocol"}) {
    request.subprotocols = name;
    EXPECT_EQ(choose_subprotocol(all_routes(), request), "") << name;
  }
  request.subprotocols = "listener, indurop.token.x,indurop.v1 , foxglove.sdk.v1";
  EXPECT_EQ(choose_subprotocol(all_routes(), request), kStream);
  for (const Route& route : all_routes()) {
    EXPECT_TRUE(route.protocol.empty() || route.protocol == kStream || is_foxglove(route.protocol)) << route.protocol;
    EXPECT_EQ(route.right == Right::Open, route.pace == Pace::Page);
    EXPECT_EQ(route.right == Right::Write, route.method == Method::Post) << route.pattern;
  }
}

}  // namespace
}  // namespace indurop::serve
