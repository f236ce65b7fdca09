// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/api/router.h"

#include <algorithm>

#include "core/base/text.h"

namespace indurop::serve {
namespace {

// Removes the next part of a path, without the slash, and returns it.
std::string_view take_part(std::string_view& path) {
  path.remove_prefix(path.starts_with('/') ? 1 : 0);
  const std::string_view part = path.substr(0, path.find('/'));
  path.remove_prefix(part.size());
  return part;
}

bool has_protocol(std::span<const Route> routes, std::string_view name) {
  return !name.empty() &&
         std::any_of(routes.begin(), routes.end(), [name](const Route& route) { return route.protocol == name; });
}

}  // namespace

std::optional<std::map<std::string, std::string, std::less<>>> match_path(std::string_view pattern,
                                                                          std::string_view path) {
  std::map<std::string, std::string, std::less<>> parts;
  if (pattern.starts_with("/{") && pattern.ends_with("...}")) {
    return path.starts_with('/') ? std::optional(std::move(parts)) : std::nullopt;
  }
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
    const bool page_for_api = route.pace == Pace::Page && request.path.starts_with("/api/");
    auto parts = match_path(route.pattern, request.path);
    if (!parts || page_for_api || route.protocol != request.subprotocol) {
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

Needed needed_for(std::span<const Route> routes, const Request& request) {
  const bool unknown_stream = request.stream && request.subprotocol.empty();
  const Match match = match_route(routes, request);
  if (match.route == nullptr || unknown_stream) {
    return {request.method == Method::Post ? Role::Operate : Role::Look, {}};
  }
  const auto board = match.call.part.find("board");
  return {match.route->role, board != match.call.part.end() ? board->second : std::string()};
}

std::string choose_subprotocol(std::span<const Route> routes, const Request& request) {
  for (std::string_view rest = request.subprotocols; !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find(','));
    if (has_protocol(routes, base::trimmed(one))) {
      return std::string(base::trimmed(one));
    }
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
  }
  return {};
}

}  // namespace indurop::serve
