// SPDX-License-Identifier: Apache-2.0
// Who may do what: every line of the table of all that can be asked, by everybody who may ask, in every way the server
// can be started. What is expected is worked out here from the method and the path alone, not from the table.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "tools/serve/api/router.h"
#include "tools/serve/door/access_gate.h"
#include "tools/serve/door/house.h"

namespace indurop::serve {
namespace {

constexpr const char* kWriteToken = "write-token-abcdefghijkl";
constexpr const char* kReadToken = "read-token-abcdefghijklm";
constexpr const char* kOperateToken = "operate-token-abcdefghij";
constexpr const char* kTuneToken = "tune-token-abcdefghijklm";
constexpr const char* kAdminToken = "administer-token-abcdefg";

// Who asks.
struct Asker {
  const char* what = "";
  const char* token = "";
  Client certificate;
  int level = 0;       // what it may do: 0 unknown, 1 look, 2 operate, 3 tune, 4 program, 5 administer
  bool wrong = false;  // showed something that does not count
};

const std::array kAskers{
    Asker{"nobody", "", {}, 0, false},
    Asker{"wrong token", "wrong-token-abcdefghijkl", {}, 0, true},
    Asker{"beginning of the token", "write-token-abcdefghijk", {}, 0, true},
    Asker{"read token", kReadToken, {}, 1, false},
    Asker{"operator's token", kOperateToken, {}, 2, false},
    Asker{"tuner's token", kTuneToken, {}, 3, false},
    Asker{"write token", kWriteToken, {}, 4, false},
    Asker{"administrator's token", kAdminToken, {}, 5, false},
    Asker{"certificate of a tool", "", {"panel", Role::Look, {}, {}, {}}, 1, false},
    Asker{"certificate of a viewer", "", {"viewer", Role::Look, {}, {}, {}}, 1, false},
    Asker{"certificate of a board", "", {"drive", Role::Look, {}, {}, {}}, 1, false},
    Asker{"certificate of a deployer", "", {"deployer", Role::Program, {}, {}, {}}, 4, false},
    Asker{"revoked certificate", "", {"deployer", Role::Unknown, "it was revoked", {}, {}}, 0, true},
    Asker{"wrong token with a deployer's certificate",
          "wrong-token-abcdefghijkl",
          {"deployer", Role::Program, {}, {}, {}},
          0,
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

AccessGateSettings settings_of(bool loopback, bool write) {
  AccessGateSettings settings;
  settings.loopback = loopback;
  settings.tls = !loopback;
  settings.write = write;
  settings.hosts = {"localhost", "127.0.0.1", "::1"};
  settings.tokens = {{"operator", kWriteToken, Role::Program},
                     {"desk", kReadToken, Role::Look},
                     {"olga", kOperateToken, Role::Operate},
                     {"tom", kTuneToken, Role::Tune},
                     {"ada", kAdminToken, Role::Administer}};
  return settings;
}

// The level that a request needs, by the last word of its path.
int level_of(const Request& request) {
  static const std::map<std::string, int> kLevels{
      {"set", 2},      {"ack", 2},     {"jog", 2},   {"keep", 2},    {"load", 2},   {"call", 2},
      {"force", 3},    {"release", 3}, {"renew", 3}, {"save", 3},    {"remove", 3}, {"shelve", 3},
      {"unshelve", 3}, {"start", 4},   {"stop", 4},  {"restart", 4}, {"lock", 4},   {"rollback", 4},
      {"replay", 4},   {"take", 3},    {"drop", 3},  {"accept", 3},  {"write", 3}};
  if ((!request.stream && !request.path.starts_with("/api/") && request.path != "/metrics") ||
      (request.method == Method::Post && request.path == "/api/v1/session")) {
    return 0;
  }
  if (request.path.starts_with("/api/v1/users")) {
    return 5;
  }
  if (request.method == Method::Get || request.path == "/api/v1/session/end") {
    return 1;
  }
  const std::string last = request.path.substr(request.path.rfind('/') + 1);
  return last == "end" ? request.path.find("/jog/") != std::string::npos ? 2 : 3 : kLevels.at(last);
}

int expected(const Request& request, const Asker& asker, const AccessGateSettings& settings) {
  const int level = level_of(request);
  if (level == 0) {
    return 0;
  }
  if (asker.wrong || (asker.level == 0 && !settings.loopback)) {
    return status::kUnauthorized;
  }
  if (level == 1 || (settings.write && asker.level >= level)) {
    return 0;
  }
  return settings.write && asker.level == 0 ? status::kUnauthorized : status::kForbidden;
}

int code_of_reply(const std::optional<Reply>& reply) {
  return reply ? reply->status : 0;
}

template <class Check>
void walk(const Check& check) {
  for (const bool loopback : {true, false}) {
    for (const bool write : {true, false}) {
      const AccessGateSettings settings = settings_of(loopback, write);
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

int answer_of(const AccessGateSettings& settings, Request request) {
  const AccessGate gate(settings);
  request.client = gate.client_of(request);
  return code_of_reply(gate.refuse(request, needed_for(all_routes(), request)));
}

TEST(WhoMay, Is_the_same_for_every_line_of_the_table) {
  walk([](const AccessGateSettings& settings, const Request& request, const Asker& asker) {
    EXPECT_EQ(answer_of(settings, request), expected(request, asker, settings));
  });
}

TEST(WhoMay, Nothing_is_answered_under_another_name_or_to_another_page) {
  walk([](const AccessGateSettings& settings, Request request, const Asker& /*asker*/) {
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
  const AccessGateSettings settings = settings_of(false, true);
  for (const char* path : {"/api/", "/api/v1", "/api/v1/nothing", "/api/v2/boards", "/api/v1/stream"}) {
    for (const Method method : {Method::Get, Method::Post}) {
      Request request = request_for({method, path, Role::Unknown, Pace::Quick, nullptr, Remote::No}, kAskers[0], true);
      EXPECT_EQ(answer_of(settings, request), status::kUnauthorized) << path;
    }
  }
}

TEST(WhoMay, A_client_of_some_boards_changes_no_other_and_not_the_plant) {
  AccessGateSettings settings = settings_of(true, true);
  for (const Route& route : all_routes()) {
    Request request = request_for(route, kAskers[0], true);
    request.certificate = {"ben", Role::Program, {}, {"press*", "table"}, {}};
    const bool changes = level_of(request) >= 2;
    const bool of_board = request.path.find("{board}") != std::string::npos;
    for (const auto& [board, own] : {std::pair("press2", true), {"table", true}, {"tables", false}, {"p", false}}) {
      Request one = request;
      if (of_board) {
        one.path.replace(one.path.find("{board}"), 7, board);
      }
      const bool allowed = !changes || (of_board && own && level_of(request) < 5);
      EXPECT_EQ(answer_of(settings, one), allowed ? 0 : status::kForbidden) << one.path;
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
    EXPECT_EQ(route.role == Role::Unknown, route.pace == Pace::Page || route.pace == Pace::SignIn);
  }
}

}  // namespace
}  // namespace indurop::serve
