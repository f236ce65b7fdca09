// SPDX-License-Identifier: Apache-2.0
// The command line of indurop-mqtt.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/problem.h"
#include "doors/mqtt/broker/broker.h"
#include "doors/mqtt/model/board.h"
#include "doors/mqtt/plain/plain.h"
#include "doors/mqtt/serve/stream.h"
#include "doors/mqtt/sparkplug/edge_node.h"

namespace indurop::mqtt {

// As given.
struct OptionTexts {
  std::string broker = "mqtt://127.0.0.1:1883";
  BrokerSettings to_broker;
  std::filesystem::path password_file;
  bool plaintext = false;
  std::string serve = "http://127.0.0.1:8080";
  std::filesystem::path serve_ca;
  std::filesystem::path token_file;
  std::vector<std::string> variables;
  double rate_hz = 10;
  std::vector<std::string> deadbands;
  std::string topic = "indurop";
  bool no_plain = false;
  bool no_retain = false;
  SparkplugSettings sparkplug;
  std::string commander;
  std::uint64_t store_mb = 200;
  std::filesystem::path state;
  bool quiet = false;
};
void declare_options(base::Options& app, OptionTexts& texts);

// As they are used.
struct Settings {
  BrokerSettings broker;  // its client_id is the beginning of those in use
  StreamSettings stream;
  std::vector<Deadband> deadbands;
  bool has_plain = true;
  PlainSettings plain;
  bool has_sparkplug = false;
  SparkplugSettings sparkplug;
  std::uint64_t store_bytes = 0;  // 0: nothing is kept
  std::filesystem::path state;
  bool quiet = false;
};
// Reads the files that are named. Errors: what is wrong with an option or a file.
Result<Settings, base::Problem> settings_of(const OptionTexts& texts);

}  // namespace indurop::mqtt
