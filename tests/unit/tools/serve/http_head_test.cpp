// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/http_head.h"

#include <gtest/gtest.h>

#include <random>

namespace indurop::serve {
namespace {

constexpr const char* kHost = "Host: localhost\r\n";

int code_of_head(const std::string& text) {
  const auto head = read_head(text);
  return head ? 0 : head.error().status;
}

int of_fields(const std::string& fields) {
  return code_of_head("GET / HTTP/1.1\r\n" + fields + "\r\n");
}

TEST(HttpHead, Is_read_into_its_parts) {
  const std::string text =
      "GET /api/v1/boards/a%3A%3Ab%5B1%5D?name=a+b%2B&empty=&flag&x=%3d HTTP/1.1\r\nHost: localhost:80\r\n"
      "ORIGIN:http://a \r\nConnection: keep-alive\r\nconnection: Upgrade\r\n\r\n";
  ASSERT_EQ(head_length(text + "rest"), text.size());
  const auto head = read_head(text);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->path, "/api/v1/boards/a::b[1]");
  const std::vector<std::pair<std::string, std::string>> query{
      {"name", "a b+"}, {"empty", ""}, {"flag", ""}, {"x", "="}};
  EXPECT_EQ(head->query, query);
  EXPECT_EQ(head->field("origin"), "http://a");
  EXPECT_EQ(head->field("connection"), "keep-alive, Upgrade");
  EXPECT_TRUE(head->has_word("connection", "upgrade") && head->has_word("connection", "Keep-Alive"));
  EXPECT_FALSE(head->has_word("connection", "close"));
  EXPECT_TRUE(head->keeps_open);
  EXPECT_EQ(request_of(*head).host, "localhost:80");
}

TEST(HttpHead, Names_one_host) {
  EXPECT_EQ(of_fields(""), 400);
  EXPECT_EQ(of_fields("Host:\r\n"), 400);
  EXPECT_EQ(of_fields(kHost), 0);
  EXPECT_EQ(of_fields(std::string(kHost) + "Host: evil.com\r\n"), 400);
  EXPECT_EQ(of_fields(std::string(kHost) + "hOsT: localhost\r\n"), 400);
}

TEST(HttpHead, Has_what_counts_once) {
  for (const char* name : {"Origin", "Authorization", "Content-Length", "Content-Type", "Transfer-Encoding",
                           "Sec-Fetch-Site", "Sec-WebSocket-Key", "Sec-WebSocket-Version"}) {
    const std::string field = std::string(name) + ": 1\r\n";
    EXPECT_EQ(of_fields(kHost + field), 0) << name;
    EXPECT_EQ(of_fields(kHost + field + field), 400) << name;
  }
  EXPECT_EQ(of_fields(std::string(kHost) + "Sec-WebSocket-Protocol: a\r\nSec-WebSocket-Protocol: b\r\n"), 0);
}

TEST(HttpHead, Cannot_be_understood_in_two_ways) {
  for (const char* fields :
       {" Host: localhost\r\n", "Host : localhost\r\n", "Host: localhost\r\n evil.com\r\n", "Host: local\nhost\r\n",
        "Host: local\rhost\r\n", "Host: a\x7f\r\n", "Host\r\n", ": x\r\n", "Host: localhost\r\nA: b\nHost: evil\r\n",
        "Host: localhost\r\nA: \nTransfer-Encoding: chunked\r\n", "Host: localhost\n\r\n", "Host: \rlocalhost\r\n",
        "Host: localhost\v\r\n", "Host:\flocalhost\r\n", "Host: localhost\r\nX y: z\r\n"}) {
    EXPECT_EQ(of_fields(fields), 400) << fields;
  }
  EXPECT_EQ(of_fields(std::string("Host: a") + '\0' + "b\r\n"), 400);
  for (const char* line :
       {"GET / HTTP/2.0", "GET / http/1.1", "GET /", "GET", "", "GET  / HTTP/1.1", "GET /a b HTTP/1.1",
        "G@T / HTTP/1.1", "GET http://evil.com/ HTTP/1.1", "CONNECT evil.com:80 HTTP/1.1", "GET /# HTTP/1.1",
        "GET /% HTTP/1.1", "GET /%4 HTTP/1.1", "GET /%zz HTTP/1.1", "GET /%00 HTTP/1.1", "GET /?a=%0 HTTP/1.1",
        "GET /\xff HTTP/1.1", "OPTIONS * HTTP/1.1"}) {
    EXPECT_EQ(code_of_head(std::string(line) + "\r\n" + kHost + "\r\n"), 400) << line;
  }
}

TEST(HttpHead, Has_limits) {
  std::string many = kHost;
  for (int i = 0; i < 200; ++i) {
    many += "A: b\r\n";
  }
  EXPECT_EQ(of_fields(many), 431);
}

TEST(HttpBody, Has_one_length) {
  const auto length = [](const std::string& fields, const std::string& method = "POST") {
    const auto head = read_head(method + " / HTTP/1.1\r\n" + kHost + fields + "\r\n");
    EXPECT_TRUE(head);
    const auto body = body_length(*head);
    return body ? static_cast<int>(*body) : -body.error().status;
  };
  EXPECT_EQ(length(""), 0);
  EXPECT_EQ(length("Content-Length: 12\r\n"), 12);
  for (const char* wrong : {"", "x", "-1", "+1", "1x", "0x1", "1 2", "1,1", "1.0"}) {
    EXPECT_EQ(length(std::string("Content-Length: ") + wrong + "\r\n"), -400) << wrong;
  }
  EXPECT_EQ(length("Content-Length: 99999999999999999999999\r\n"), -413);
  EXPECT_EQ(length("Content-Length: 262145\r\n"), -413);
  EXPECT_EQ(length("Transfer-Encoding: chunked\r\n"), -400);
  EXPECT_EQ(length("Content-Length: 5\r\n", "GET"), -400);
  EXPECT_EQ(length("Content-Length: 0\r\n", "GET"), 0);
}

TEST(HttpHead, Any_bytes_are_survived) {
  std::mt19937 random(2);  // NOLINT: the same each time
  const std::string good = "POST /a%41?b=c HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\n";
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    for (auto changes = random() % 4; changes > 0; --changes) {
      text[random() % text.size()] =
          static_cast<char>(random() % 4 == 0 ? "\r\n: %"[random() % 5] : static_cast<int>(random() % 256));
    }
    if (const auto head = read_head(text.substr(0, random() % 2 == 0 ? text.size() : random() % text.size()))) {
      EXPECT_FALSE(head->field("host").empty());
      (void)body_length(*head);
    }
  }
}

}  // namespace
}  // namespace indurop::serve
