// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/broker/broker.h"

#include <fmt/format.h>
#include <mosquitto.h>

#include <chrono>
#include <utility>

#include "doors/mqtt/serve/connection.h"

namespace indurop::mqtt {
namespace {

constexpr int kKeepAliveS = 10;
constexpr int kLoopMs = 200;
constexpr std::chrono::milliseconds kRetry{1000};
constexpr const char* kNoTopic = "indurop/receipt";

const char* path_or_null(const std::filesystem::path& path) {
  return path.empty() ? nullptr : path.c_str();
}

std::string reason_of_mqtt(int code) {
  return code == MOSQ_ERR_ERRNO ? std::error_code(errno, std::generic_category()).message() : mosquitto_strerror(code);
}

}  // namespace

Broker::Broker(BrokerSettings settings, std::function<Will()> next_will, BrokerEvents events, Mailbox& mailbox)
    : settings_(std::move(settings)),
      next_will_(std::move(next_will)),
      events_(std::move(events)),
      mailbox_(&mailbox),
      client_((mosquitto_lib_init(), mosquitto_new(settings_.client_id.c_str(), true, this))) {
  mosquitto_threaded_set(client_, true);
  mosquitto_int_option(client_, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V311);
  if (!settings_.user.empty()) {
    mosquitto_username_pw_set(client_, settings_.user.c_str(), settings_.password.c_str());
  }
  if (settings_.address.tls) {
    mosquitto_tls_set(client_, path_or_null(settings_.ca), settings_.ca.empty() ? "/etc/ssl/certs" : nullptr,
                      path_or_null(settings_.cert), path_or_null(settings_.key), nullptr);
  }
  add_callbacks();
}

Broker::~Broker() {
  {
    const std::lock_guard guard(mutex_);
    stopped_ = true;
  }
  stop_.notify_all();
  reconnect();
  if (thread_.joinable()) {
    thread_.join();
  }
  mosquitto_destroy(client_);
  mosquitto_lib_cleanup();
}

void Broker::add_callbacks() {
  mosquitto_connect_callback_set(client_, [](mosquitto* /*client*/, void* self, int code) {
    auto& broker = *static_cast<Broker*>(self);
    if (code != 0) {
      broker.report(fmt::format("the broker refuses the connection: {}", mosquitto_connack_string(code)));
      return;
    }
    broker.connected_ = true;
    broker.last_trouble_.clear();
    broker.mailbox_->post([&broker, will = broker.will_.load()] {
      if (will == broker.will_) {  // else it has ended already
        broker.events_.connected(will);
      }
    });
  });
  mosquitto_message_callback_set(client_, [](mosquitto* /*client*/, void* self, const mosquitto_message* message) {
    static_cast<Broker*>(self)->receive(
        message->topic,
        std::string(static_cast<const char*>(message->payload), static_cast<std::size_t>(message->payloadlen)),
        message->retain);
  });
  mosquitto_unsubscribe_callback_set(client_, [](mosquitto* /*client*/, void* self, int id) {
    auto& broker = *static_cast<Broker*>(self);
    broker.mailbox_->post([&broker, id] { broker.events_.confirmed(id); });
  });
}

void Broker::receive(const std::string& topic, const std::string& payload, bool retained) {
  // What does not fit is lost, as it may be with this quality of service.
  (void)mailbox_->post([this, topic, payload, retained] { events_.message(topic, payload, retained); });
}

void Broker::start() {
  thread_ = std::thread([this] { run(); });
}

bool Broker::publish(const std::string& topic, std::string_view payload, Retain retain) {
  return connected_ && mosquitto_publish(client_, nullptr, topic.c_str(), static_cast<int>(payload.size()),
                                         payload.data(), 0, retain == Retain::Yes) == MOSQ_ERR_SUCCESS;
}

void Broker::subscribe(const std::string& filter) {
  mosquitto_subscribe(client_, nullptr, filter.c_str(), 1);
}

// An unsubscription of a topic that was never subscribed to changes nothing, and a broker answers it after everything
// that came before.
int Broker::request_receipt() {
  int id = 0;
  return connected_ && mosquitto_unsubscribe(client_, &id, kNoTopic) == MOSQ_ERR_SUCCESS ? id : 0;
}

void Broker::reconnect() {
  ending_ = true;
}

void Broker::report(const std::string& text) {
  if (text != last_trouble_) {
    last_trouble_ = text;
    mailbox_->post([this, text] { events_.trouble(text); });
  }
}

void Broker::wait() {
  std::unique_lock guard(mutex_);
  stop_.wait_for(guard, kRetry, [this] { return stopped_; });
}

void Broker::set_will() {
  const Will will = next_will_();
  will_ = will.number;
  mosquitto_will_set(client_, will.topic.c_str(), static_cast<int>(will.payload.size()), will.payload.data(),
                     will.quality_of_service, will.retain);
}

// libmosquitto would wait for minutes for a host that does not answer.
bool Broker::connect() {
  if (auto reached = try_to_reach(settings_.address); !reached) {
    report(reached.error().text);
    return false;
  }
  set_will();
  const int code = mosquitto_connect(client_, settings_.address.host.c_str(), settings_.address.port, kKeepAliveS);
  if (code != MOSQ_ERR_SUCCESS) {
    report(fmt::format("{} cannot be reached: {}", settings_.address.host_and_port(), reason_of_mqtt(code)));
  }
  return code == MOSQ_ERR_SUCCESS;
}

// Sends what is left, then ends the connection: the broker does not publish the will.
void Broker::end_connection() {
  constexpr int kMostRounds = 100;
  for (int i = 0; i < kMostRounds && mosquitto_want_write(client_); ++i) {
    mosquitto_loop(client_, kLoopMs / 10, 1);
  }
  mosquitto_disconnect(client_);
  for (int i = 0; i < kMostRounds && mosquitto_socket(client_) >= 0; ++i) {
    mosquitto_loop(client_, kLoopMs / 10, 1);
  }
}

void Broker::run() {
  const auto stopped = [this] {
    const std::lock_guard guard(mutex_);
    return stopped_;
  };
  while (!stopped()) {
    ending_ = false;
    if (!connect()) {
      wait();
      continue;
    }
    int code = MOSQ_ERR_SUCCESS;
    while (code == MOSQ_ERR_SUCCESS && !ending_ && !stopped()) {
      code = mosquitto_loop(client_, kLoopMs, 1);
    }
    const bool was = connected_;
    if (code == MOSQ_ERR_SUCCESS) {
      end_connection();
    } else if (code != MOSQ_ERR_CONN_REFUSED) {  // whose reason was reported
      report(fmt::format("the connection to {} was lost: {}", settings_.address.host_and_port(), reason_of_mqtt(code)));
    }
    connected_ = false;
    if (was) {
      mailbox_->post([this] { events_.lost(); });
    }
    wait();
  }
}

}  // namespace indurop::mqtt
