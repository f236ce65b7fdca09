// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/access_gate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/base/name_patterns.h"
#include "core/base/text.h"

namespace indurop::serve {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

constexpr std::string_view kBearer = "Bearer ";
constexpr std::string_view kTokenProtocol = "indurop.token.";

Reply refuse_right(std::string why) {
  Reply reply = refusal(status::kForbidden, why);
  reply.lacks_right = std::move(why);
  return reply;
}

bool is_json(std::string_view content_type) {
  return lower(base::trimmed(content_type.substr(0, content_type.find(';')))) == "application/json";
}

}  // namespace

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

bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const unsigned other = a.empty() ? 0 : static_cast<unsigned char>(a[i % a.size()]);
    difference |= other ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

// Converts "[::1]:8080" to "::1", "LocalHost:8080" to "localhost".
std::string host_name(std::string_view host) {
  constexpr std::size_t kLongestPort = 5;
  const auto end = host.starts_with('[') ? host.find(']') : host.find(':');
  if (host.starts_with('[') && end == std::string_view::npos) {
    return {};
  }
  std::string_view rest = end == std::string_view::npos ? std::string_view() : host.substr(end);
  const std::string_view name = host.starts_with('[') ? host.substr(1, end - 1) : host.substr(0, end);
  rest.remove_prefix(rest.starts_with(']') ? 1 : 0);
  if (!rest.empty()) {
    const std::string_view port = rest.substr(1);
    const bool number = !port.empty() && port.size() <= kLongestPort &&
                        std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!rest.starts_with(':') || !number) {
      return {};
    }
  }
  return lower(name);
}

Client AccessGate::client_of(const Request& request) const {
  const std::string_view sent = sent_token(request);
  return sent.empty() ? request.certificate : client_of_token(sent, !request.background);
}

Client AccessGate::client_of_token(std::string_view sent, bool use) const {
  if (accounts_ != nullptr) {
    if (auto client = accounts_->client_of_token(sent, use)) {
      return std::move(*client);
    }
  }
  Client client;
  client.refusal = "the token is wrong, or its session has ended";
  for (const Token& token : settings_.tokens) {  // checks all of them, so that the time does not reveal which one
                                                 // matches
    if (equal_in_constant_time(token.value, sent)) {
      client = {token.name, token.role, {}, {}, {}};
    }
  }
  return client;
}

bool AccessGate::host_known(std::string_view host) const {
  const std::string name = host_name(host);
  return !name.empty() && std::find(settings_.hosts.begin(), settings_.hosts.end(), name) != settings_.hosts.end();
}

bool AccessGate::same_origin(const Request& request) const {
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

std::optional<Reply> AccessGate::refuse_client(const Client& client, const Needed& needed) const {
  if (needed.role == Role::Unknown) {
    return std::nullopt;
  }
  if (!client.refusal.empty()) {
    Reply reply = refusal(status::kUnauthorized, client.refusal);
    reply.wrong_credentials = client.refusal;
    return reply;
  }
  if (client.role == Role::Unknown && !settings_.loopback) {
    return refusal(status::kUnauthorized, "a user, a token or a client certificate is needed");
  }
  if (needed.role == Role::Look) {
    return std::nullopt;
  }
  if (!settings_.write) {
    return refusal(status::kForbidden, "this server only shows; start it with --write to let it write");
  }
  if (client.role == Role::Unknown) {
    return refusal(status::kUnauthorized, "writing needs a user, a token or a client certificate");
  }
  if (client.role < needed.role) {
    return refuse_right(fmt::format("{} has the role {}; this needs the role {}", client.name, word_of(client.role),
                                    word_of(needed.role)));
  }
  if (!client.boards.empty() && (needed.board.empty() || !base::matches_any(client.boards, needed.board))) {
    return refuse_right(fmt::format("{} may change {} only", client.name, fmt::join(client.boards, ", ")));
  }
  return std::nullopt;
}

std::optional<Reply> AccessGate::refuse(const Request& request, const Needed& needed) const {
  if (!host_known(request.host)) {
    return refusal(status::kMisdirected, "this server is not called '" + request.host +
                                             "'; start it with --host NAME to let it be called so");
  }
  if (!same_origin(request)) {
    return refusal(status::kForbidden, "a page of another site may not ask this server");
  }
  if (request.method == Method::Other) {
    Reply reply = refusal(status::kMethodNotAllowed, "only GET and POST are answered");
    reply.allow = "GET, POST";
    return reply;
  }
  if (auto refused = refuse_client(request.client, needed)) {
    return refused;
  }
  if (request.has_body && !is_json(request.content_type)) {
    return refusal(status::kNotJson, "the body has to be JSON, with the header Content-Type: application/json");
  }
  return std::nullopt;
}

}  // namespace indurop::serve
