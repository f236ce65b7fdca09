// SPDX-License-Identifier: Apache-2.0
// The inside of the door: connections by the handles of libwebsockets, and what its callbacks do with them.

#pragma once

#include <libwebsockets.h>

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "serve/door/door.h"
#include "serve/door/exchange.h"
#include "serve/door/house.h"
#include "serve/door/listener.h"

namespace indurop::serve {

// A client with a WebSocket.
class Stream final : public Line {
 public:
  explicit Stream(lws* wsi) : wsi_(wsi) {}
  void ask() override { lws_callback_on_writable(wsi_); }

  lws* wsi_;
  std::unique_ptr<Visitor> visitor;
  std::string incoming;  // parts of a message so far
};

struct Door::Impl {
  Impl(DoorSettings door_settings, House& owner, Listener own_listener)
      : settings(std::move(door_settings)), house(&owner), listener(std::move(own_listener)) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();

  static int on_http(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size);
  static int on_stream(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size);
  static int on_listener(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size);
  static Impl& of(lws* wsi);

  bool adopt_listener();
  void let_in();
  int requested(lws* wsi, std::string path);
  int body_came(lws* wsi, std::string_view part);
  int answer(Exchange& exchange);
  int too_slow(lws* wsi);
  int stream_asked(lws* wsi);
  int stream_heard(lws* wsi, std::string_view part);
  int stream_writable(lws* wsi);
  void forget(lws* wsi);
  void give_replies();

  DoorSettings settings;
  House* house;
  Listener listener;
  lws_context* context = nullptr;
  std::array<lws_protocols, 6> protocols{};
  std::unordered_map<lws*, std::unique_ptr<Exchange>> exchanges;
  std::unordered_map<lws*, std::unique_ptr<Stream>> streams;
  std::unordered_map<lws*, Request> admitted;  // to a WebSocket that is being set up
  std::size_t connections = 0;
  Ticket last_ticket = 0;
  std::mutex lock;
  std::vector<std::pair<Ticket, Reply>> replies;  // of other threads
};

}  // namespace indurop::serve
