// SPDX-License-Identifier: Apache-2.0
#include "serve/door/gate.h"

#include <algorithm>
#include <cctype>

#include "base/text.h"

namespace indurop::serve {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// "[::1]:8080" -> "::1", "localhost:8080" -> "localhost".
std::string without_port(std::string_view host) {
  if (host.starts_with('[')) {
    const auto end = host.find(']');
    return lower(end == std::string_view::npos ? host : host.substr(1, end - 1));
  }
  return lower(host.substr(0, host.rfind(':')));
}

constexpr std::string_view kBearer = "Bearer ";
// Who has these keys of a plant may only look (docs/security.md).
constexpr std::string_view kViewer = "viewer";
constexpr std::string_view kTokenProtocol = "indurop.token.";

// The token as it was sent, in a header or, by the WebSocket of a browser, as a subprotocol. Empty: none.
std::string_view sent_token(const Request& request) {
  const std::string_view header = request.authorization;
  if (header.starts_with(kBearer)) {
    return base::trimmed(header.substr(kBearer.size()));
  }
  std::string_view rest = request.stream ? std::string_view(request.subprotocols) : std::string_view();
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    const std::string_view one = base::trimmed(rest.substr(0, comma));
    if (one.starts_with(kTokenProtocol)) {
      return one.substr(kTokenProtocol.size());
    }
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
  }
  return {};
}

bool is_json(std::string_view content_type) {
  return lower(base::trimmed(content_type.substr(0, content_type.find(';')))) == "application/json";
}

}  // namespace

bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const unsigned other = a.empty() ? 0 : static_cast<unsigned char>(a[i % a.size()]);
    difference |= other ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

std::string Gate::who(const Request& request) const {
  const std::string_view sent = sent_token(request);
  std::string name;
  for (const Token& token : settings_.tokens) {  // all of them: the time does not tell which
    if (equal_in_constant_time(token.value, sent) && !sent.empty()) {
      name = token.name;
    }
  }
  return name.empty() ? request.certificate : name;
}

bool Gate::host_known(std::string_view host) const {
  const std::string name = without_port(host);
  return std::find(settings_.hosts.begin(), settings_.hosts.end(), name) != settings_.hosts.end();
}

bool Gate::same_origin(const Request& request) const {
  if (request.origin.empty()) {
    return request.fetch_site.empty() || request.fetch_site == "same-origin" || request.fetch_site == "none" ||
           (request.method == Method::Get && !request.stream);
  }
  const auto known = [&](const std::string& one) { return lower(one) == lower(request.origin); };
  if (request.stream && std::any_of(settings_.origins.begin(), settings_.origins.end(), known)) {
    return true;
  }
  return lower(request.origin) == (settings_.tls ? "https://" : "http://") + lower(request.host);
}

std::optional<Reply> Gate::refuse(const Request& request) const {
  if (!host_known(request.host)) {
    return refusal(status::kMisdirected, "this server is not called '" + request.host +
                                             "'; start it with --host NAME to let it be called so");
  }
  if (!same_origin(request)) {
    return refusal(status::kForbidden, "a page of another site may not ask this server");
  }
  const bool api = request.stream || request.path.starts_with("/api/");
  if (request.method == Method::Other) {
    Reply reply = refusal(status::kMethodNotAllowed, "only GET and POST are answered");
    reply.allow = "GET, POST";
    return reply;
  }
  const bool known = !who(request).empty();
  if (api && !known && !sent_token(request).empty()) {
    return refusal(status::kUnauthorized, "the token is wrong");
  }
  if (api && !known && !settings_.loopback) {
    return refusal(status::kUnauthorized, "a token or a client certificate is needed");
  }
  if (request.method != Method::Post) {
    return std::nullopt;
  }
  if (!settings_.write) {
    return refusal(status::kForbidden, "this server only shows; start it with --write to let it write");
  }
  if (!known) {
    return refusal(status::kUnauthorized, "writing needs a token or a client certificate");
  }
  if (sent_token(request).empty() && request.certificate == kViewer) {
    return refusal(status::kForbidden, "the keys of a viewer let look, not write");
  }
  if (request.has_body && !is_json(request.content_type)) {
    return refusal(status::kNotJson, "the body has to be JSON, with the header Content-Type: application/json");
  }
  return std::nullopt;
}

}  // namespace indurop::serve
