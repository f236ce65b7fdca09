// SPDX-License-Identifier: Apache-2.0
// What the door does for connections that speak HTTP.
#include <fmt/format.h>

#include "serve/door/door_impl.h"

namespace indurop::serve {
namespace {

// Less than the library gives it, which closes without a word.
constexpr lws_usec_t kBodyMicroseconds = 8 * LWS_USEC_PER_SEC;

}  // namespace

int Door::Impl::requested(lws* wsi, std::string path) {
  Request request = read_request(wsi, std::move(path));
  const BodyLength length = request.method == Method::Get ? BodyLength{} : read_length(wsi);
  request.has_body = length.bytes > 0;
  if (auto refused = house->refuse(request)) {
    return Exchange::refuse(wsi, *refused);
  }
  if (length.refusal) {
    return Exchange::refuse(wsi, *length.refusal);
  }
  if (connections > settings.most_connections) {
    return Exchange::refuse(wsi, refusal(status::kUnavailable, "there are too many connections; try again later"));
  }
  auto& exchange = exchanges[wsi];
  exchange = std::make_unique<Exchange>(wsi, ++last_ticket, std::move(request));
  if (length.bytes > 0) {
    exchange->expect_body();
    lws_set_timer_usecs(wsi, kBodyMicroseconds);
    return 0;
  }
  return answer(*exchange);
}

int Door::Impl::body_came(lws* wsi, std::string_view part) {
  const auto found = exchanges.find(wsi);
  if (found == exchanges.end()) {
    return -1;
  }
  std::string& body = found->second->request().body;
  if (body.size() + part.size() > kMostBody) {
    return Exchange::refuse(wsi, refusal(status::kTooLarge, fmt::format("a body has at most {} bytes", kMostBody)));
  }
  body += part;
  return 0;
}

int Door::Impl::answer(Exchange& exchange) {
  exchange.body_is_here();
  auto reply = house->answer(exchange.request(), exchange.ticket());
  if (reply) {
    return exchange.begin(std::move(*reply));
  }
  lws_set_timeout(exchange.wsi(), NO_PENDING_TIMEOUT, 0);  // however long it takes
  return 0;
}

int Door::Impl::too_slow(lws* wsi) {
  const auto found = exchanges.find(wsi);
  if (found == exchanges.end() || !found->second->waits_for_body()) {
    return 0;
  }
  return Exchange::refuse(wsi, refusal(status::kTimeout, "the body did not come in time"));
}

void Door::Impl::forget(lws* wsi) {
  exchanges.erase(wsi);
  admitted.erase(wsi);
}

void Door::Impl::give_replies() {
  std::vector<std::pair<Ticket, Reply>> given;
  {
    const std::lock_guard guard(lock);
    given.swap(replies);
  }
  for (auto& [ticket, reply] : given) {
    for (const auto& [wsi, exchange] : exchanges) {
      if (exchange->ticket() == ticket && exchange->begin(std::move(reply)) != 0) {
        lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
      }
    }
  }
}

int Door::Impl::on_http(lws* wsi, lws_callback_reasons reason, void* /*user*/, void* in, std::size_t size) {
  const auto text = [in, size] { return std::string_view(static_cast<const char*>(in), size); };
  switch (reason) {
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:  // a WebSocket without our subprotocol
      return Exchange::refuse(wsi, refusal(status::kBadRequest, "a WebSocket needs the subprotocol indurop.v1"));
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      ++of(wsi).connections;
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      of(wsi).connections -= of(wsi).connections > 0 ? 1U : 0U;
      of(wsi).forget(wsi);
      return 0;
    case LWS_CALLBACK_HTTP:
      return of(wsi).requested(wsi, std::string(text()));
    case LWS_CALLBACK_HTTP_BODY:
      return of(wsi).body_came(wsi, text());
    case LWS_CALLBACK_HTTP_BODY_COMPLETION: {
      const auto found = of(wsi).exchanges.find(wsi);
      if (found == of(wsi).exchanges.end()) {
        return -1;
      }
      // Of a body of no bytes the library tells too, after the request was answered.
      return found->second->waits_for_body() ? of(wsi).answer(*found->second) : 0;
    }
    case LWS_CALLBACK_HTTP_WRITEABLE: {
      const auto found = of(wsi).exchanges.find(wsi);
      return found == of(wsi).exchanges.end() ? 0 : found->second->go_on();
    }
    case LWS_CALLBACK_TIMER:
      return of(wsi).too_slow(wsi);
    case LWS_CALLBACK_CLOSED_HTTP:
      of(wsi).forget(wsi);
      return 0;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      of(wsi).give_replies();
      return 0;
    default:
      return 0;
  }
}

}  // namespace indurop::serve
