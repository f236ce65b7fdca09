// SPDX-License-Identifier: Apache-2.0
#include "core/schema/ros_name.h"

namespace indurop::schema {
namespace {

// Not the functions of <cctype>, which depend on the locale.
bool is_upper(char c) noexcept {
  return c >= 'A' && c <= 'Z';
}
bool is_lower(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}
char to_lower(char c) noexcept {
  return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
}
char to_upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

// A word begins at a capital after a small letter, and at the last of several capitals: "TCPPose" is "tcp_pose".
std::string snake(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_' || name[i] == ':') {
      if (!out.empty() && out.back() != '_') {
        out += '_';
      }
      continue;
    }
    const bool after_small = i > 0 && is_lower(name[i - 1]);
    const bool last_capital = i > 0 && is_upper(name[i - 1]) && i + 1 < name.size() && is_lower(name[i + 1]);
    if (is_upper(name[i]) && (after_small || last_capital) && !out.empty() && out.back() != '_') {
      out += '_';
    }
    out += to_lower(name[i]);
  }
  while (!out.empty() && out.back() == '_') {
    out.pop_back();
  }
  return out;
}

std::size_t last_scope(std::string_view name) noexcept {
  const std::size_t at = name.rfind("::");
  return at == std::string_view::npos ? 0 : at;
}

}  // namespace

std::string ros_package(std::string_view scope) {
  return (scope.empty() ? std::string("indurop") : snake(scope)) + "_msgs";
}

std::string ros_message(std::string_view type) {
  std::string out;
  bool begins = true;
  for (const char c : type) {
    if (c == '_') {
      begins = true;
      continue;
    }
    out += begins ? to_upper(c) : c;
    begins = false;
  }
  return out;
}

std::string ros_field(std::string_view field) {
  return snake(field);
}

std::string ros_constant(std::string_view enumerator) {
  std::string out = snake(enumerator);
  for (char& c : out) {
    c = to_upper(c);
  }
  return out;
}

std::string ros_topic(std::string_view variable) {
  std::string topic = "rt/";
  for (std::size_t i = 0; i < variable.size(); ++i) {
    if (variable.substr(i, 2) == "::") {
      topic += '/';
      ++i;
    } else {
      topic += variable[i];
    }
  }
  return topic;
}

std::string ros_type_name(const Variable& variable) {
  const bool plain = variable.type.base == Base::Struct && variable.type.dims.empty();
  const std::string_view name = plain ? variable.type.name : variable.name;
  const std::size_t at = last_scope(name);
  const std::string_view last = at == 0 ? name : name.substr(at + 2);
  return ros_package(name.substr(0, at)) + "::msg::dds_::" + ros_message(last) + "_";
}

}  // namespace indurop::schema
