// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "core/base/read_file.h"
#include "core/base/text.h"
#include "doors/mqtt/plain/topics.h"

namespace indurop::mqtt {
namespace {

constexpr std::uint64_t kMega = 1'000'000;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : std::string("host");
}

std::filesystem::path usual_state_folder() {
  const auto from_environment = [](const char* name) -> std::string {
    const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): read before threads are started
    return value == nullptr ? "" : value;
  };
  if (const std::string chosen = from_environment("INDUROP_STATE_DIR"); !chosen.empty()) {
    return std::filesystem::path(chosen) / "mqtt";
  }
  return ::geteuid() == 0 ? std::filesystem::path("/var/lib/indurop/mqtt")
                          : std::filesystem::path(from_environment("HOME")) / ".local/state/indurop/mqtt";
}

Result<std::vector<Deadband>, base::Problem> read_deadbands(const std::vector<std::string>& texts) {
  std::vector<Deadband> all;
  for (const std::string& text : texts) {
    const auto equals = text.rfind('=');
    Deadband one;
    one.pattern = text.substr(0, equals);
    const char* const end = text.data() + text.size();
    const char* const begin = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto parsed = std::from_chars(begin, end, one.distance);
    if (parsed.ec != std::errc() || parsed.ptr != end || one.pattern.empty() || !(one.distance >= 0)) {
      return base::Problem{
          fmt::format("--deadband is GLOB=DISTANCE, such as 'press::*=0.5', not {}", base::in_quotes(text))};
    }
    all.push_back(std::move(one));
  }
  return all;
}

Result<BrokerSettings, base::Problem> broker_of(const OptionTexts& texts) {
  BrokerSettings broker = texts.to_broker;
  const auto address = read_address(texts.broker, kMqtt);
  if (!address) {
    return base::Problem{"--broker: " + address.error().text};
  }
  broker.address = *address;
  if (!address->tls && !address->is_loopback() && !texts.plaintext) {
    return base::Problem{"values and passwords would travel unencrypted: use --broker mqtts://..., or say --plaintext"};
  }
  if (broker.cert.empty() != broker.key.empty()) {
    return base::Problem{"--broker-cert and --broker-key belong together"};
  }
  if (!texts.password_file.empty()) {
    const auto text = base::read_file(texts.password_file);
    if (!text) {
      return base::Problem{base::cannot_read(texts.password_file, text.error())};
    }
    broker.password = text->substr(0, text->find_first_of("\r\n"));
  }
  if (broker.client_id.empty()) {
    broker.client_id = "indurop-" + host_name();
  }
  return broker;
}

Result<void, base::Problem> add_users(const OptionTexts& texts, Settings& settings) {
  if (texts.token_file.empty()) {
    return texts.commander.empty() ? Result<void, base::Problem>()
                                   : base::Problem{"--commander is a name of --token-file, which is missing"};
  }
  auto tokens = read_tokens(texts.token_file);
  if (!tokens) {
    return std::move(tokens).error();
  }
  settings.stream.token = tokens->front().token;
  const auto commander = std::find_if(tokens->begin(), tokens->end(),
                                      [&texts](const UserToken& one) { return one.user == texts.commander; });
  if (commander != tokens->end()) {
    settings.sparkplug.commander = *commander;
  } else if (!texts.commander.empty()) {
    return base::Problem{fmt::format("{} has no token of user {}", texts.token_file.string(), texts.commander)};
  }
  settings.plain.users = std::move(*tokens);
  return {};
}

}  // namespace

// Long: it is a list.
void declare_options(base::Options& app, OptionTexts& texts) {
  constexpr double kLeastHz = 0.1;
  constexpr double kMostHz = 100;
  constexpr double kMostMb = 2000;
  const auto file = [](base::Option option) { option.completes(base::Completion::File); };
  app.add("--broker", "URL", texts.broker, "The broker, mqtt:// or mqtts:// (default mqtt://127.0.0.1:1883)");
  file(app.add("--broker-ca", "FILE", texts.to_broker.ca, "Authority of the broker's certificate (PEM)"));
  file(app.add("--broker-cert", "FILE", texts.to_broker.cert, "Certificate for the broker (PEM)"));
  file(app.add("--broker-key", "FILE", texts.to_broker.key, "Private key of --broker-cert (PEM)"));
  app.add("--broker-user", "NAME", texts.to_broker.user, "User at the broker");
  file(app.add("--broker-password-file", "FILE", texts.password_file,
               "File whose first line is the password of the user"));
  app.add("--client-id", "NAME", texts.to_broker.client_id, "Beginning of the client id (default: indurop-HOST)");
  app.flag("--plaintext", texts.plaintext, "Allow mqtt:// to another host, without encryption");
  app.add("--serve", "URL", texts.serve,
          "The indurop serve whose boards are published (default http://127.0.0.1:8080)");
  file(app.add("--serve-ca", "FILE", texts.serve_ca, "Authority of its certificate (PEM)"));
  file(app.add("--token-file", "FILE", texts.token_file,
               "Lines 'NAME TOKEN': the first is used for reading, all may send commands within their roles"));
  app.add("--variables", "GLOB", texts.variables, "Publish these variables or parts of them (default: all)")
      .one_at_a_time()
      .completes(base::Completion::Variable);
  app.add("--rate", "HZ", texts.rate_hz, "How often values are sampled (default 10)").range(kLeastHz, kMostHz);
  app.add("--deadband", "GLOB=DISTANCE", texts.deadbands, "Publish these numbers when they differ by more than this")
      .one_at_a_time();
  app.add("--topic", "PREFIX", texts.topic, "First level of plain topics (default indurop)");
  app.flag("--no-plain", texts.no_plain, "No plain topics");
  app.flag("--no-retain", texts.no_retain, "The broker does not keep values of plain topics");
  app.add("--sparkplug", "GROUP", texts.sparkplug.group, "Be an edge node of Sparkplug B in this group");
  app.add("--edge-node", "NAME", texts.sparkplug.node, "Name of the edge node (default: the host's)");
  app.add("--primary-host", "NAME", texts.sparkplug.primary_host, "Keep data while this host is offline");
  app.add("--commander", "USER", texts.commander, "User of --token-file in whose name Sparkplug commands are executed");
  app.add("--store", "MB", texts.store_mb,
          "Maximum Sparkplug data to keep while the broker is unreachable (default 200)")
      .range(0, kMostMb);
  app.add("--state", "DIR", texts.state, "Folder for stored data (default: mqtt in the state folder)")
      .completes(base::Completion::Folder);
  app.flag("-q,--quiet", texts.quiet, "Print warnings and errors only");
}

Result<Settings, base::Problem> settings_of(const OptionTexts& texts) {
  Settings settings;
  auto broker = broker_of(texts);
  auto deadbands = read_deadbands(texts.deadbands);
  const auto serve = read_address(texts.serve, kHttp);
  if (!broker || !deadbands || !serve) {
    return !broker      ? std::move(broker).error()
           : !deadbands ? std::move(deadbands).error()
                        : base::Problem{"--serve: " + serve.error().text};
  }
  settings.broker = std::move(*broker);
  settings.deadbands = std::move(*deadbands);
  settings.stream = {{*serve, texts.serve_ca}, {}, texts.variables, texts.rate_hz};
  if (settings.stream.names.empty()) {
    settings.stream.names.emplace_back("*");
  }
  settings.has_plain = !texts.no_plain;
  settings.plain = {texts.topic, texts.no_retain ? Retain::No : Retain::Yes, {}};
  settings.has_sparkplug = !texts.sparkplug.group.empty();
  settings.sparkplug = texts.sparkplug;
  if (settings.sparkplug.node.empty()) {
    settings.sparkplug.node = host_name();
  }
  settings.store_bytes = texts.store_mb * kMega;
  settings.state = texts.state.empty() ? usual_state_folder() : texts.state;
  settings.quiet = texts.quiet;
  if (!settings.has_plain && !settings.has_sparkplug) {
    return base::Problem{"nothing would be published: --no-plain needs --sparkplug GROUP"};
  }
  for (const std::string& name :
       {texts.topic, settings.sparkplug.node, texts.sparkplug.primary_host + "x", texts.sparkplug.group + "x"}) {
    if (!is_level(name)) {
      return base::Problem{
          fmt::format("{} cannot be one level of a topic: it has one of / + #", base::in_quotes(name))};
    }
  }
  if (auto added = add_users(texts, settings); !added) {
    return std::move(added).error();
  }
  return settings;
}

}  // namespace indurop::mqtt
