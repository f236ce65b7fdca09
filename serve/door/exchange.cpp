// SPDX-License-Identifier: Apache-2.0
#include "serve/door/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "serve/door/door.h"

namespace indurop::serve {
namespace {

constexpr std::size_t kPiece = 32U << 10;
constexpr int kSendSeconds = 30;  // for a client to take a piece
constexpr int kEnd = -1;          // ends the connection in every callback; some do not mind other numbers

std::string header(lws* wsi, lws_token_indexes which) {
  const int length = lws_hdr_total_length(wsi, which);
  if (length <= 0) {
    return {};
  }
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  const int copied = lws_hdr_copy(wsi, text.data(), length + 1, which);
  text.resize(copied > 0 ? static_cast<std::size_t>(copied) : 0);
  return text;
}

std::string custom_header(lws* wsi, const std::string& name) {
  const int length = lws_hdr_custom_length(wsi, name.c_str(), static_cast<int>(name.size()));
  if (length <= 0) {
    return {};
  }
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  const int copied = lws_hdr_custom_copy(wsi, text.data(), length + 1, name.c_str(), static_cast<int>(name.size()));
  text.resize(copied > 0 ? static_cast<std::size_t>(copied) : 0);
  return text;
}

std::vector<std::pair<std::string, std::string>> query_of(lws* wsi) {
  constexpr int kLongest = 1024;
  std::vector<std::pair<std::string, std::string>> query;
  std::array<char, kLongest> one{};
  int length = 0;
  for (int i = 0; (length = lws_hdr_copy_fragment(wsi, one.data(), kLongest, WSI_TOKEN_HTTP_URI_ARGS, i)) > 0; ++i) {
    const std::string_view text(one.data(), static_cast<std::size_t>(length));
    const auto equals = text.find('=');
    query.emplace_back(text.substr(0, equals), equals == std::string_view::npos ? "" : text.substr(equals + 1));
  }
  return query;
}

Method method_of(lws* wsi) {
  char* path = nullptr;
  int length = 0;
  switch (lws_http_get_uri_and_method(wsi, &path, &length)) {
    case LWSHUMETH_GET:
      return Method::Get;
    case LWSHUMETH_POST:
      return Method::Post;
    default:
      return Method::Other;
  }
}

// Name in the client's certificate, if it was verified.
std::string certificate_of(lws* wsi) {
  lws_tls_cert_info_results result{};
  if (lws_tls_peer_cert_info(wsi, LWS_TLS_CERT_INFO_VERIFIED, &result, 0) != 0 || result.verified == 0) {
    return {};
  }
  if (lws_tls_peer_cert_info(wsi, LWS_TLS_CERT_INFO_COMMON_NAME, &result, sizeof result.ns.name) != 0) {
    return {};
  }
  const char* name = result.ns.name;
  return {name, static_cast<std::size_t>(std::max(result.ns.len, 0))};
}

// Writes a reply's head into `buffer`; null if it does not fit.
using HeadBuffer = std::array<unsigned char, LWS_PRE + 2048>;
bool write_head(lws* wsi, const Reply& reply, HeadBuffer& buffer) {
  unsigned char* const begin = buffer.data() + LWS_PRE;
  unsigned char* at = begin;
  unsigned char* const end = buffer.data() + buffer.size() - 1;
  const auto add = [&](const char* name, const std::string& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(value.data());
    return lws_add_http_header_by_name(wsi, reinterpret_cast<const unsigned char*>(name), bytes,
                                       static_cast<int>(value.size()), &at, end) == 0;
  };
  return lws_add_http_common_headers(wsi, static_cast<unsigned>(reply.status), reply.type.c_str(), reply.body.size(),
                                     &at, end) == 0 &&
         add("cache-control:", reply.immutable ? "public, max-age=31536000, immutable" : "no-store") &&
         add("x-content-type-options:", "nosniff") && add("x-frame-options:", "DENY") &&
         add("referrer-policy:", "no-referrer") && add("cross-origin-resource-policy:", "same-origin") &&
         add("content-security-policy:",
             "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; connect-src 'self' ws: "
             "wss:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'") &&
         (!reply.close || add("connection:", "close")) && (reply.allow.empty() || add("allow:", reply.allow)) &&
         (reply.status != status::kUnauthorized || add("www-authenticate:", "Bearer")) &&
         lws_finalize_write_http_header(wsi, begin, &at, end) == 0;
}

// Sends `size` bytes of the body from `from` on; false if the connection is lost.
bool write_piece(lws* wsi, const Reply& reply, std::size_t from, std::size_t size) {
  if (size == 0) {
    return true;
  }
  std::vector<unsigned char> buffer(LWS_PRE + size);
  std::copy_n(reply.body.begin() + static_cast<std::ptrdiff_t>(from), size,
              buffer.begin() + static_cast<std::ptrdiff_t>(LWS_PRE));
  const bool last = from + size == reply.body.size();
  return lws_write(wsi, buffer.data() + LWS_PRE, size, last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) >= 0;
}

}  // namespace

Request read_request(lws* wsi, std::string path) {
  constexpr std::size_t kLongestAddress = 64;
  Request request;
  request.method = method_of(wsi);
  request.path = std::move(path);
  request.query = query_of(wsi);
  request.host = header(wsi, WSI_TOKEN_HOST);
  request.origin = header(wsi, WSI_TOKEN_ORIGIN);
  request.fetch_site = custom_header(wsi, "sec-fetch-site:");
  request.authorization = header(wsi, WSI_TOKEN_HTTP_AUTHORIZATION);
  request.subprotocols = header(wsi, WSI_TOKEN_PROTOCOL);
  request.content_type = header(wsi, WSI_TOKEN_HTTP_CONTENT_TYPE);
  request.close = header(wsi, WSI_TOKEN_CONNECTION).find("lose") != std::string::npos;  // close, Close
  request.certificate = certificate_of(wsi);
  std::array<char, kLongestAddress> address{};
  lws_get_peer_simple(wsi, address.data(), address.size());
  const std::string_view from = address.data();
  constexpr std::string_view kMapped = "::ffff:";  // an IPv4 address, as an IPv6 socket shows it
  request.from = from.starts_with(kMapped) ? from.substr(kMapped.size()) : from;
  return request;
}

BodyLength read_length(lws* wsi) {
  BodyLength out;
  if (lws_hdr_total_length(wsi, WSI_TOKEN_HTTP_TRANSFER_ENCODING) > 0) {
    out.refusal = refusal(status::kBadRequest, "the body has to come whole, with Content-Length");
    return out;
  }
  const std::string text = header(wsi, WSI_TOKEN_HTTP_CONTENT_LENGTH);
  out.unknown = text.empty();
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, out.bytes);
  if (parsed.ec == std::errc::result_out_of_range || out.bytes > kMostBody) {
    out.refusal = refusal(status::kTooLarge, fmt::format("a body has at most {} bytes", kMostBody));
  } else if (!out.unknown && (parsed.ec != std::errc() || parsed.ptr != end)) {
    out.refusal = refusal(status::kBadRequest, "Content-Length is no number");
  }
  return out;
}

int Exchange::begin(Reply reply) {
  reply_ = std::move(reply);
  reply_.close = reply_.close || request_.close;
  replying_ = true;
  HeadBuffer head{};
  if (!write_head(wsi_, reply_, head)) {
    return kEnd;
  }
  lws_set_timeout(wsi_, PENDING_TIMEOUT_HTTP_CONTENT, kSendSeconds);
  lws_callback_on_writable(wsi_);
  return 0;
}

int Exchange::go_on() {
  if (!replying_) {
    return 0;
  }
  const std::size_t size = std::min(kPiece, reply_.body.size() - sent_);
  if (!write_piece(wsi_, reply_, sent_, size)) {
    return kEnd;
  }
  sent_ += size;
  if (sent_ < reply_.body.size()) {
    lws_set_timeout(wsi_, PENDING_TIMEOUT_HTTP_CONTENT, kSendSeconds);
    lws_callback_on_writable(wsi_);
    return 0;
  }
  replying_ = false;
  return reply_.close || lws_http_transaction_completed(wsi_) != 0 ? kEnd : 0;
}

int Exchange::refuse(lws* wsi, const Reply& reply) {
  HeadBuffer head{};
  if (write_head(wsi, reply, head)) {
    write_piece(wsi, reply, 0, reply.body.size());
  }
  return kEnd;
}

}  // namespace indurop::serve
