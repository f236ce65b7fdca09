// SPDX-License-Identifier: Apache-2.0
#include "serve/door/door.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "serve/door/door_impl.h"

namespace indurop::serve {
namespace {

constexpr unsigned short kMostHeaders = 8192;
constexpr unsigned kHeaderSeconds = 10;
constexpr int kKeepAliveSeconds = 60;
// A WebSocket that is silent for the first time is asked whether it lives, after the second it is closed.
constexpr std::uint16_t kPingSeconds = 15;
constexpr std::uint16_t kSilentSeconds = 30;

const lws_retry_bo_t& idle_policy() {
  static const lws_retry_bo_t kPolicy = [] {
    lws_retry_bo_t made{};
    made.secs_since_valid_ping = kPingSeconds;
    made.secs_since_valid_hangup = kSilentSeconds;
    return made;
  }();
  return kPolicy;
}

void say(int level, const char* line) {
  if ((level & LLL_ERR) != 0) {
    (void)std::fprintf(stderr, "indurop-serve: %s", line);
  }
}

void add_tls(lws_context_creation_info& info, const DoorSettings& settings) {
  info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
  info.ssl_cert_filepath = settings.cert.c_str();
  info.ssl_private_key_filepath = settings.key.c_str();
  info.alpn = "http/1.1";
  if (!settings.client_ca.empty()) {
    info.options |= LWS_SERVER_OPTION_REQUIRE_VALID_OPENSSL_CLIENT_CERT | LWS_SERVER_OPTION_PEER_CERT_NOT_REQUIRED;
    info.ssl_ca_filepath = settings.client_ca.c_str();
  }
}

}  // namespace

struct Door::Alarm::State {
  lws_sorted_usec_list_t entry{};  // first: the library gives us its address
  lws_context* context = nullptr;
  std::function<void()> ring;

  static void rang(lws_sorted_usec_list_t* entry) { reinterpret_cast<State*>(entry)->ring(); }
};

Door::Alarm::Alarm(Door& door, std::function<void()> ring) : state_(std::make_unique<State>()) {
  state_->context = door.impl_->context;
  state_->ring = std::move(ring);
}

Door::Alarm::~Alarm() {
  stop();
}

void Door::Alarm::set(std::int64_t after_ns) {
  constexpr std::int64_t kNsPerUs = 1000;
  lws_sul_schedule(state_->context, 0, &state_->entry, &State::rang, std::max<std::int64_t>(after_ns / kNsPerUs, 1));
}

void Door::Alarm::stop() {
  lws_sul_schedule(state_->context, 0, &state_->entry, &State::rang, LWS_SET_TIMER_USEC_CANCEL);
}

Door::Impl& Door::Impl::of(lws* wsi) {
  return *static_cast<Impl*>(lws_context_user(lws_get_context(wsi)));
}

Door::Impl::~Impl() {
  if (context != nullptr) {
    lws_context_destroy(context);
  }
}

Door::Door(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Door::~Door() = default;

Result<std::unique_ptr<Door>, base::Problem> Door::open(const DoorSettings& settings, House& house) {
  constexpr std::size_t kSpareFiles = 64;
  auto listener = Listener::open(settings.bind, settings.port);
  if (!listener) {
    return std::move(listener).error();
  }
  auto impl = std::make_unique<Impl>(settings, house, std::move(listener).value());
  const auto rx = static_cast<std::size_t>(kMostHeaders);
  impl->protocols[0] = {"http", &Impl::on_http, 0, rx, 0, nullptr, 0};
  impl->protocols[1] = {"indurop.v1", &Impl::on_stream, 0, rx, 0, nullptr, 0};
  impl->protocols[2] = {kFoxgloveSdk, &Impl::on_stream, 0, rx, 0, nullptr, 0};
  impl->protocols[3] = {kFoxglove, &Impl::on_stream, 0, rx, 0, nullptr, 0};
  impl->protocols[4] = {"listener", &Impl::on_listener, 0, rx, 0, nullptr, 0};
  lws_set_log_level(LLL_ERR, &say);
  lws_context_creation_info info{};
  info.port = CONTEXT_PORT_NO_LISTEN_SERVER;
  info.protocols = impl->protocols.data();
  info.user = impl.get();
  info.gid = static_cast<decltype(info.gid)>(-1);
  info.uid = static_cast<decltype(info.uid)>(-1);
  info.server_string = "indurop";
  info.max_http_header_data = kMostHeaders;
  info.timeout_secs = kHeaderSeconds;
  info.timeout_secs_ah_idle = kHeaderSeconds;
  info.keepalive_timeout = kKeepAliveSeconds;
  info.retry_and_idle_policy = &idle_policy();
  info.fd_limit_per_thread = static_cast<unsigned>(impl->settings.most_connections + kSpareFiles);
  if (!impl->settings.cert.empty()) {
    add_tls(info, impl->settings);
  }
  impl->context = lws_create_context(&info);
  lws_set_log_level(0, &say);  // from now on it would only tell what clients do wrong
  auto door = std::unique_ptr<Door>(new Door(std::move(impl)));
  if (!door->impl_->adopt_listener()) {
    return base::Problem{
        settings.cert.empty()
            ? "libwebsockets cannot start"
            : fmt::format("{} and {} cannot be used for TLS: they do not belong together, or cannot be read",
                          settings.cert.string(), settings.key.string())};
  }
  return door;
}

bool Door::Impl::adopt_listener() {
  lws_vhost* const host = context != nullptr ? lws_get_vhost_by_name(context, "default") : nullptr;
  if (host == nullptr) {
    return false;
  }
  // The library closes what it is given.
  lws_sock_file_fd_type file{};
  file.filefd = fcntl(listener.file(), F_DUPFD_CLOEXEC, 0);
  return file.filefd >= 0 &&
         lws_adopt_descriptor_vhost(host, LWS_ADOPT_RAW_FILE_DESC, file, "listener", nullptr) != nullptr;
}

void Door::Impl::let_in() {
  lws_vhost* const host = lws_get_vhost_by_name(context, "default");
  constexpr int kAtOnce = 16;
  for (int i = 0; i < kAtOnce; ++i) {
    const int file = listener.take();
    if (file < 0 || lws_adopt_socket_vhost(host, file) == nullptr) {
      return;
    }
  }
}

int Door::Impl::on_listener(lws* wsi, lws_callback_reasons reason, void* /*user*/, void* /*in*/, std::size_t /*size*/) {
  if (reason == LWS_CALLBACK_RAW_RX_FILE) {
    of(wsi).let_in();
  }
  return 0;
}

int Door::port() const {
  return impl_->listener.port();
}

void Door::serve(const std::function<bool()>& ended) {
  while (!ended() && lws_service(impl_->context, 0) >= 0) {
  }
}

void Door::reply(Ticket ticket, Reply reply) {
  {
    const std::lock_guard guard(impl_->lock);
    impl_->replies.emplace_back(ticket, std::move(reply));
  }
  lws_cancel_service(impl_->context);
}

}  // namespace indurop::serve
