// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/api/router.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/json.h"
#include "tools/serve/api/api.h"

namespace indurop::serve {
namespace {

Match match(Method method, std::string path) {
  Request request;
  request.method = method;
  request.path = std::move(path);
  return match_route(all_routes(), request);
}

TEST(Router, Takes_parts_out_of_a_path) {
  const auto parts = match_path("/a/{one}/b/{two}", "/a/x/b/knu::Robot::joints[1].y");
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->at("one"), "x");
  EXPECT_EQ(parts->at("two"), "knu::Robot::joints[1].y");
  for (const char* path : {"/a/x/b", "/a/x/b/", "/a/x/b/c/d", "/a//b/c", "/b/x/b/c", "", "/"}) {
    EXPECT_FALSE(match_path("/a/{one}/b/{two}", path)) << path;
  }
}

TEST(Router, Tells_a_wrong_method_from_a_wrong_path) {
  EXPECT_NE(match(Method::Get, "/api/v1/boards").route, nullptr);
  EXPECT_TRUE(match(Method::Post, "/api/v1/boards").other_method);
  EXPECT_TRUE(match(Method::Get, "/api/v1/boards/a/set").other_method);
  EXPECT_FALSE(match(Method::Get, "/api/v1/nothing").other_method);
}

TEST(Router, Has_the_paths_of_the_description_and_no_others) {
  const auto description = base::Json::parse(api_description());
  ASSERT_TRUE(description);
  std::set<std::string> described;
  const base::Json& paths = (*description)["paths"];
  for (const std::string& path : paths.keys()) {
    for (const std::string& method : paths[path].keys()) {
      if (method != "parameters") {
        described.insert(method + " " + path);
      }
    }
  }
  std::set<std::string> routed;
  for (const Route& route : all_routes()) {
    if (route.answer == nullptr) {
      continue;  // streams, and files of the page
    }
    routed.insert(std::string(route.method == Method::Post ? "post " : "get ") + std::string(route.pattern));
  }
  EXPECT_EQ(routed, described);
}

TEST(Description, Is_of_the_version_the_server_tells) {
  const auto description = base::Json::parse(api_description());
  EXPECT_EQ((*description)["info"]["version"].text(), kApiVersion);
}

}  // namespace
}  // namespace indurop::serve
