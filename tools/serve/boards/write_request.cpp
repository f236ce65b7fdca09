// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/write_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/json.h"

namespace indurop::serve {

Result<WriteRequest, std::string> read_write_request(const std::string& body) {
  const auto json = base::Json::parse(body);
  if (!json || !json->is_object()) {
    return std::string("the body is no JSON object");
  }
  WriteRequest request;
  if (!base::read_if_given(*json, "reason", request.reason)) {
    return std::string("reason is a text");
  }
  if (!base::read_if_given(*json, "names", request.names)) {
    return std::string("names is a list of texts");
  }
  // A force whose "lease" is not understood would never end.
  if (!base::read_if_given(*json, "all", request.all) || !base::read_if_given(*json, "lease", request.lease)) {
    return std::string("all and lease are true or false");
  }
  if (request.lease && json->find("for_ns") != nullptr) {
    return std::string("lease and for_ns are two ways of ending: choose one");
  }
  if (json->find("for_ns") != nullptr && (!base::read(*json, "for_ns", request.for_ns) || request.for_ns <= 0)) {
    return std::string("for_ns is a whole number of nanoseconds from 1 to 9223372036854775807");
  }
  if (const base::Json* const values = json->find("values")) {
    if (!values->is_object() || values->values().empty()) {
      return std::string("values is an object of NAME: value");
    }
    std::size_t i = 0;
    for (const std::string& name : values->keys()) {
      const base::Json& value = values->values()[i++];
      request.values.emplace_back(name, value.is_text() ? *value.text() : value.dump());
    }
  }
  return request;
}

std::string text_of(const WriteRequest& request) {
  std::string text;
  for (const auto& [name, value] : request.values) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
  }
  return text.empty() ? fmt::format("{}", fmt::join(request.names, " ")) : text;
}

}  // namespace indurop::serve
