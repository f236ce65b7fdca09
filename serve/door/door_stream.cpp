// SPDX-License-Identifier: Apache-2.0
// What the door does for connections that have become WebSockets.
#include "serve/door/door_impl.h"

namespace indurop::serve {
namespace {

// Closes with a code; the result is that of the callback.
int close_with(lws* wsi, int code) {
  lws_close_reason(wsi, static_cast<lws_close_status>(code), nullptr, 0);
  return -1;
}

std::string path_of(lws* wsi) {
  char* path = nullptr;
  int length = 0;
  return lws_http_get_uri_and_method(wsi, &path, &length) >= 0 ? std::string(path, static_cast<std::size_t>(length))
                                                               : std::string();
}

}  // namespace

int Door::Impl::stream_asked(lws* wsi) {
  Request request = read_request(wsi, path_of(wsi));
  request.stream = true;
  request.subprotocol = lws_get_protocol(wsi)->name;
  if (auto refused = house->refuse(request)) {
    return Exchange::refuse(wsi, *refused);
  }
  if (request.path != "/api/v1/stream" && !is_foxglove(request.subprotocol)) {
    return Exchange::refuse(wsi, refusal(status::kNotFound, "the WebSocket is at /api/v1/stream"));
  }
  if (streams.size() >= settings.most_streams || connections > settings.most_connections) {
    return Exchange::refuse(wsi, refusal(status::kUnavailable, "there are too many clients; see --clients"));
  }
  admitted[wsi] = std::move(request);
  return 0;
}

int Door::Impl::stream_heard(lws* wsi, std::string_view part) {
  const auto found = streams.find(wsi);
  if (found == streams.end()) {
    return -1;
  }
  if (lws_frame_is_binary(wsi) != 0) {
    return close_with(wsi, close_code::kNotUnderstood);
  }
  std::string& message = found->second->incoming;
  if (message.size() + part.size() > kMostMessage) {
    return close_with(wsi, close_code::kTooLarge);
  }
  message += part;
  if (lws_is_final_fragment(wsi) == 0 || lws_remaining_packet_payload(wsi) > 0) {
    return 0;
  }
  const std::string whole = std::exchange(message, {});
  const int code = found->second->visitor->heard(whole);
  return code == 0 ? 0 : close_with(wsi, code);
}

int Door::Impl::stream_writable(lws* wsi) {
  static_assert(Message::kRoom >= LWS_PRE);
  const auto found = streams.find(wsi);
  if (found == streams.end()) {
    return -1;
  }
  const SharedMessage message = found->second->visitor->next();
  if (!message) {
    return 0;
  }
  const auto kind = message->binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT;
  if (lws_write(wsi, message->bytes.data() + Message::kRoom, message->size(), kind) < 0) {
    return -1;
  }
  lws_callback_on_writable(wsi);
  return 0;
}

int Door::Impl::on_stream(lws* wsi, lws_callback_reasons reason, void* /*user*/, void* in, std::size_t size) {
  switch (reason) {
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
      return of(wsi).stream_asked(wsi);
    case LWS_CALLBACK_ESTABLISHED: {
      Impl& door = of(wsi);
      auto stream = std::make_unique<Stream>(wsi);
      stream->visitor = door.house->receive(door.admitted[wsi], *stream);
      door.admitted.erase(wsi);
      door.streams[wsi] = std::move(stream);
      lws_callback_on_writable(wsi);
      return 0;
    }
    case LWS_CALLBACK_RECEIVE:
      return of(wsi).stream_heard(wsi, {static_cast<const char*>(in), size});
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return of(wsi).stream_writable(wsi);
    case LWS_CALLBACK_CLOSED:
      of(wsi).streams.erase(wsi);
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      return on_http(wsi, reason, nullptr, in, size);
    default:
      return 0;
  }
}

}  // namespace indurop::serve
