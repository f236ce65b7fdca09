// SPDX-License-Identifier: Apache-2.0
// `indurop-mqtt`: the boards of an `indurop serve` for MQTT, as plain topics with JSON and as Sparkplug B.

#include <fmt/format.h>

#include <cstdio>

#include "core/base/exit_code.h"
#include "core/base/print.h"
#include "core/base/stop_signal.h"
#include "doors/mqtt/door.h"
#include "doors/mqtt/options.h"

namespace indurop::mqtt {
namespace {

constexpr const char* kDetails =
    R"(Publishes values when they have changed. Waits for server and broker, and connects again.
  indurop-mqtt
  indurop-mqtt --sparkplug plant1
  indurop-mqtt --broker mqtts://broker.local --broker-ca ca.pem --token-file tokens
)";

int fail(const std::string& text, int code) {
  base::print(stderr, "indurop-mqtt: error: {}\n", text);
  return code;
}

int run(const OptionTexts& texts) {
  base::StopSignal stop;
  auto settings = settings_of(texts);
  if (!settings) {
    return fail(settings.error().text, kUsage);
  }
  Door door(std::move(*settings));
  if (const auto done = door.run(stop); !done) {
    return fail(done.error().text, kFailed);
  }
  constexpr int kSignalBase = 128;
  return kSignalBase + stop.received();
}

}  // namespace
}  // namespace indurop::mqtt

int main(int argc, char** argv) {
  using namespace indurop;
  base::Options app("indurop-mqtt", "Publish boards over MQTT, plainly or as Sparkplug B");
  app.version(INDUROP_VERSION);
  mqtt::OptionTexts texts;
  mqtt::declare_options(app, texts);
  app.details(mqtt::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kInterrupted, kTerminated});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return mqtt::run(texts);
}
