// SPDX-License-Identifier: Apache-2.0
// A connection to a broker of MQTT 3.1.1 on a thread of its own, which is made again whenever it is lost. The only file
// that includes libmosquitto is its .cpp.

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/problem.h"
#include "doors/mqtt/broker/outlet.h"
#include "doors/mqtt/mailbox.h"
#include "doors/mqtt/serve/address.h"

struct mosquitto;

namespace indurop::mqtt {

struct BrokerSettings {
  Address address;
  std::filesystem::path ca;    // of the broker's certificate; empty: the authorities of the system
  std::filesystem::path cert;  // of this client; empty: none
  std::filesystem::path key;
  std::string user;  // empty: none
  std::string password;
  std::string client_id;
};

// What the broker publishes if this client vanishes.
struct Will {
  std::string topic;
  std::string payload;
  bool retain = false;
  int quality_of_service = 0;
  std::uint64_t number = 0;  // handed to `connected`
};

// Called by the thread that runs the mailbox.
struct BrokerEvents {
  std::function<void(std::uint64_t will)> connected;
  std::function<void()> lost;
  std::function<void(const std::string& topic, const std::string& payload, bool retained)> message;
  std::function<void(int receipt)> confirmed;
  std::function<void(const std::string& text)> trouble;  // why it is not connected; once for each reason
};

class Broker final : public Outlet {
 public:
  // `next_will` is called by the thread of the connection, before each attempt.
  Broker(BrokerSettings settings, std::function<Will()> next_will, BrokerEvents events, Mailbox& mailbox);
  // Ends the connection after what was published.
  ~Broker() override;

  // Begins to connect.
  void start();
  bool publish(const std::string& topic, std::string_view payload, Retain retain) override;
  void subscribe(const std::string& filter) override;
  int request_receipt() override;
  void reconnect() override;

 private:
  void run();
  // Returns true once the broker has been asked for a connection.
  bool connect();
  void set_will();
  void wait();
  void report(const std::string& text);
  void end_connection();
  void add_callbacks();
  void receive(const std::string& topic, const std::string& payload, bool retained);

  BrokerSettings settings_;
  std::function<Will()> next_will_;
  BrokerEvents events_;
  Mailbox* mailbox_;
  mosquitto* client_;
  std::atomic<bool> connected_ = false;
  std::atomic<bool> ending_ = false;
  std::atomic<std::uint64_t> will_ = 0;  // number of the present one
  std::string last_trouble_;             // of the thread
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace indurop::mqtt
