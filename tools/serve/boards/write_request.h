// SPDX-License-Identifier: Apache-2.0
// The request in the body of a set, a force or a release.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace indurop::serve {

// A parsed request body.
struct WriteRequest {
  std::vector<std::pair<std::string, std::string>> values;  // name, and value in the syntax of `indurop set`
  std::vector<std::string> names;
  std::string reason;
  std::int64_t for_ns = 0;
  bool all = false;
  bool lease = false;
};

// Parses a body, or returns what is wrong with it.
Result<WriteRequest, std::string> read_write_request(const std::string& body);
// The request as text for the audit log.
std::string text_of(const WriteRequest& request);

}  // namespace indurop::serve
