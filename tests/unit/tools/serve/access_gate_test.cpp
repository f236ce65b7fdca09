// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/access_gate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "tools/serve/admission.h"
#include "tools/serve/api/router.h"

namespace indurop::serve {
namespace {

constexpr const char* kToken = "abcdefghijklmnopqrstuvwxyz";

Request look(std::string path = "/api/v1/boards") {
  Request request;
  request.path = std::move(path);
  request.host = "127.0.0.1:8080";
  return request;
}

Request write() {
  Request request = look("/api/v1/boards/local/set");
  request.method = Method::Post;
  request.has_body = true;
  request.content_type = "application/json";
  request.authorization = std::string("Bearer ") + kToken;
  return request;
}

AccessGateSettings here(bool writes) {
  AccessGateSettings settings;
  settings.write = writes;
  settings.hosts = {"localhost", "127.0.0.1", "::1"};
  settings.tokens = {{"operator", kToken}};
  return settings;
}

// What the table asks for these.
std::optional<Reply> refusal_of(const AccessGate& gate, Request request) {
  request.client = gate.client_of(request);
  return gate.refuse(request, needed_for(all_routes(), request));
}

int code(const std::optional<Reply>& reply) {
  return reply ? reply->status : 0;
}

TEST(AccessGate, Lets_anybody_on_this_machine_look) {
  EXPECT_EQ(code(refusal_of(AccessGate(here(false)), look())), 0);
}

TEST(AccessGate, Refuses_names_that_are_not_this_machine) {
  const AccessGate gate(here(false));
  for (const char* host : {"evil.example", "evil.example:8080", "", "127.0.0.1.evil.example", "[::2]:8080",
                           "localhost:evil.com", "localhost:", "localhost:80:80", "localhost:123456", "[::1", "[::1]x",
                           "[::1]:x", "localhost@evil.com", "localhost.", " "}) {
    Request request = look();
    request.host = host;
    EXPECT_EQ(code(refusal_of(gate, request)), 421) << host;
  }
  for (const char* host : {"localhost", "LocalHost:8080", "[::1]:8080", "127.0.0.1"}) {
    Request request = look();
    request.host = host;
    EXPECT_EQ(code(refusal_of(gate, request)), 0) << host;
  }
}

TEST(AccessGate, Refuses_pages_of_other_sites) {
  const AccessGate gate(here(true));
  for (const char* origin : {"http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081", "null"}) {
    Request request = write();
    request.origin = origin;
    EXPECT_EQ(code(refusal_of(gate, request)), 403) << origin;
  }
  Request own = write();
  own.origin = "http://127.0.0.1:8080";
  EXPECT_EQ(code(refusal_of(gate, own)), 0);
  Request unnamed = write();
  unnamed.fetch_site = "cross-site";
  EXPECT_EQ(code(refusal_of(gate, unnamed)), 403);
}

TEST(AccessGate, Lets_pages_of_named_origins_follow_variables_and_do_nothing_else) {
  AccessGateSettings settings = here(true);
  settings.origins = {"https://app.foxglove.dev"};
  const AccessGate gate(settings);
  Request stream = look();
  stream.stream = true;
  stream.path = "/";
  for (const char* origin : {"https://app.foxglove.dev", "HTTPS://App.Foxglove.Dev"}) {
    stream.origin = origin;
    EXPECT_EQ(code(refusal_of(gate, stream)), 0) << origin;
  }
  for (const char* origin : {"http://app.foxglove.dev", "https://app.foxglove.dev.evil.example", "null"}) {
    stream.origin = origin;
    EXPECT_EQ(code(refusal_of(gate, stream)), 403) << origin;
  }
  Request order = write();
  order.origin = "https://app.foxglove.dev";
  EXPECT_EQ(code(refusal_of(gate, order)), 403);
}

TEST(AccessGate, Wants_to_know_who_follows_from_elsewhere_whatever_the_path) {
  AccessGateSettings settings = here(false);
  settings.loopback = false;
  Request stream = look();
  stream.stream = true;
  stream.path = "/";
  EXPECT_EQ(code(refusal_of(AccessGate(settings), stream)), 401);
}

TEST(AccessGate, Rejects_writes_without_the_option_and_a_token) {
  EXPECT_EQ(code(refusal_of(AccessGate(here(false)), write())), 403);
  const AccessGate gate(here(true));
  EXPECT_EQ(code(refusal_of(gate, write())), 0);
  Request wrong = write();
  wrong.authorization = "Bearer abcdefghijklmnopqrstuvwxyy";
  EXPECT_EQ(code(refusal_of(gate, wrong)), 401);
  wrong.authorization.clear();
  EXPECT_EQ(code(refusal_of(gate, wrong)), 401);
  wrong.certificate = {"deployer", Role::Program, {}, {}, {}};
  EXPECT_EQ(code(refusal_of(gate, wrong)), 0);
  wrong.certificate = {"viewer", Role::Look, {}, {}, {}};
  EXPECT_EQ(code(refusal_of(gate, wrong)), 403);
  wrong.certificate = {"drive", Role::Unknown, "revoked", {}, {}};
  EXPECT_EQ(code(refusal_of(gate, wrong)), 401);
}

TEST(AccessGate, Takes_a_body_only_as_json) {
  const AccessGate gate(here(true));
  Request request = write();
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "application/jsonp"}) {
    request.content_type = type;
    EXPECT_EQ(code(refusal_of(gate, request)), 415) << type;
  }
  request.content_type = "Application/JSON; charset=utf-8";
  EXPECT_EQ(code(refusal_of(gate, request)), 0);
}

TEST(AccessGate, Asks_everybody_who_comes_from_outside_for_a_token) {
  AccessGateSettings settings = here(false);
  settings.loopback = false;
  settings.tls = true;
  const AccessGate gate(settings);
  EXPECT_EQ(code(refusal_of(gate, look())), 401);
  EXPECT_EQ(code(refusal_of(gate, look("/index.html"))), 0);  // the page itself is no secret
  Request stream = look("/api/v1/stream");
  stream.stream = true;
  EXPECT_EQ(code(refusal_of(gate, stream)), 401);
  stream.subprotocols = std::string("indurop.v1, indurop.token.") + kToken;
  EXPECT_EQ(code(refusal_of(gate, stream)), 0);
  EXPECT_EQ(gate.client_of(stream).name, "operator");
}

TEST(AccessGate, Answers_get_and_post_only) {
  Request request = look();
  request.method = Method::Other;
  EXPECT_EQ(code(refusal_of(AccessGate(here(true)), request)), 405);
}

TEST(ConstantTime, Is_equality) {
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_TRUE(equal_in_constant_time("", ""));
  for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
           {"abc", "abd"}, {"abc", "ab"}, {"ab", "abc"}, {"", "a"}, {"a", ""}, {"abab", "ab"}}) {
    EXPECT_FALSE(equal_in_constant_time(a, b)) << a << " " << b;
  }
}

TEST(Tokens, Have_a_name_and_are_long_enough) {
  const auto tokens = parse_tokens(std::string("# who\n\npanel ") + kToken + "\nana\t" + kToken + "1 \n");
  ASSERT_TRUE(tokens);
  ASSERT_EQ(tokens->size(), 2U);
  EXPECT_EQ((*tokens)[1].name, "ana");
  EXPECT_EQ((*tokens)[1].value, std::string(kToken) + "1");
  EXPECT_EQ((*tokens)[1].role, Role::Program);
  EXPECT_EQ(parse_tokens(std::string("desk ") + kToken + " read\n")->front().role, Role::Look);
  for (const char* text : {"", "panel\n", "panel short\n", "abcdefghijklmnopqrstuvwxyz\n",
                           "panel abcdefghijklmnopqrstuvw xyz\n", "panel abcdefghijklmnopqrstuvwx,yz\n"}) {
    EXPECT_FALSE(parse_tokens(text)) << text;
  }
}

TEST(Admission, Requires_tls_and_a_client_with_rights_for_other_machines) {
  tools::ServeOptions options;
  options.bind = "0.0.0.0";
  EXPECT_FALSE(admission_of(options));
  options.cert = "a.pem";
  EXPECT_FALSE(admission_of(options));
  options.key = "a.key";
  EXPECT_FALSE(admission_of(options));
  options.client_ca = "no such ca.pem";
  EXPECT_FALSE(admission_of(options));
  options.client_ca.clear();
  options.token_file = std::filesystem::temp_directory_path() / ("tokens" + std::to_string(getpid()));
  const auto admission = admission_of(options);
  std::filesystem::remove(options.token_file);
  ASSERT_TRUE(admission);
  EXPECT_FALSE(admission->gate.loopback);
  EXPECT_TRUE(admission->gate.tls);
}

TEST(Admission, Makes_a_token_of_its_own_to_write) {
  tools::ServeOptions options;
  EXPECT_TRUE(admission_of(options)->gate.tokens.empty());
  options.write = true;
  const auto first = admission_of(options);
  const auto second = admission_of(options);
  ASSERT_EQ(first->gate.tokens.size(), 1U);
  EXPECT_GE(first->gate.tokens[0].value.size(), 32U);
  EXPECT_NE(first->gate.tokens[0].value, second->gate.tokens[0].value);
}

}  // namespace
}  // namespace indurop::serve
