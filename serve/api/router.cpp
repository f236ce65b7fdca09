// SPDX-License-Identifier: Apache-2.0
#include "serve/api/router.h"

namespace indurop::serve {
namespace {

// Takes the next part of a path off its front, without the slash.
std::string_view take_part(std::string_view& path) {
  path.remove_prefix(path.starts_with('/') ? 1 : 0);
  const std::string_view part = path.substr(0, path.find('/'));
  path.remove_prefix(part.size());
  return part;
}

}  // namespace

std::optional<std::map<std::string, std::string, std::less<>>> match_path(std::string_view pattern,
                                                                          std::string_view path) {
  std::map<std::string, std::string, std::less<>> parts;
  while (!pattern.empty() && !path.empty()) {
    const std::string_view wanted = take_part(pattern);
    const std::string_view found = take_part(path);
    if (wanted.starts_with('{') && !found.empty()) {
      parts.emplace(wanted.substr(1, wanted.size() - 2), found);
    } else if (wanted != found) {
      return std::nullopt;
    }
  }
  return pattern.empty() && path.empty() ? std::optional(std::move(parts)) : std::nullopt;
}

Match match_route(std::span<const Route> routes, const Request& request) {
  Match match;
  match.call.request = &request;
  for (const Route& route : routes) {
    auto parts = match_path(route.pattern, request.path);
    if (!parts) {
      continue;
    }
    if (route.method == request.method) {
      match.route = &route;
      match.call.part = std::move(*parts);
      return match;
    }
    match.other_method = true;
  }
  return match;
}

}  // namespace indurop::serve
