// SPDX-License-Identifier: Apache-2.0
// libiodispat.so: I/O dispatch as a module of the node (chapter, Figure 9). Property "config" names the ioconfig.xml,
// relative names start at the folder of the module.xml; property "phase" (both, inputs, outputs) splits it among two
// modules.

#include <indurop/indurop.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "control/io/dispatcher.h"
#include "control/io/slaves/simulated_wire.h"
#include "core/schema/schema.h"
#include "store/runtime/host.h"

namespace {

using namespace indurop;

struct Module {
  std::unique_ptr<io::Dispatcher> dispatcher;
  std::int64_t last_release = 0;
};

// The instance of this copy of the file: two modules with the same file have one each.
Module& self() {
  static Module module;
  return module;
}

std::filesystem::path config_file() {
  std::filesystem::path named = irp::property("config", "");
  if (named.empty()) {
    throw std::runtime_error(
        "no ioconfig.xml named; add <property><value name=\"config\">ioconfig.xml</value></property>");
  }
  return (std::filesystem::path(runtime::config_file()).parent_path() / named).lexically_normal();
}

io::Phase phase() {
  const std::string word = irp::property("phase", "both");
  if (word == "both") {
    return io::Phase::Both;
  }
  if (word != "inputs" && word != "outputs") {
    throw std::runtime_error("property phase is '" + word + "'; write both, inputs or outputs");
  }
  return word == "inputs" ? io::Phase::Inputs : io::Phase::Outputs;
}

io::Dispatcher::MakeWires simulation() {
  if (!runtime::virtual_ns()) {
    return {};
  }
  return [](const config::IoConfig& config) {
    return io::slaves::simulated_wires(config, [] { return runtime::virtual_ns().value_or(0); });
  };
}

void on_start() {
  self().last_release = 0;
  const auto schema = schema::from_json(runtime::schema_text());
  if (!schema) {
    throw std::runtime_error("the node's variables cannot be read: " + std::string(to_string(schema.error().code)));
  }
  const std::filesystem::path file = config_file();
  io::Dispatcher::Made made = io::Dispatcher::make(file, schema.value(), phase(), simulation());
  for (const base::Diagnostic& diagnostic : made.diagnostics) {
    irp::printf("%s\n", base::to_string(diagnostic));
  }
  auto& dispatcher = self().dispatcher;
  dispatcher = std::move(made.dispatcher);
  if (dispatcher == nullptr) {
    throw std::runtime_error(file.string() + " cannot be used, see the messages above");
  }
  if (const Status status = dispatcher->start(runtime::current_module()); !status) {
    throw std::runtime_error(dispatcher->problem().empty() ? "no thread for a device" : dispatcher->problem());
  }
}

// As the schedule counts it, lost periods included; after a long stall only a part, because simulated devices need
// computing time for theirs. Virtual time waits for them.
std::chrono::nanoseconds elapsed_until(std::int64_t release) {
  constexpr int kMaxPeriods = 10;
  const std::chrono::nanoseconds since(release - self().last_release);
  if (self().last_release == 0) {
    return irp::period();
  }
  return runtime::virtual_ns() ? since : std::min(since, kMaxPeriods * irp::period());
}

void on_run() {
  const std::int64_t release = irp::release_ns();
  if (!self().dispatcher->run(elapsed_until(release))) {
    throw std::runtime_error(self().dispatcher->problem());
  }
  self().last_release = release;
}

void on_stop() {
  self().dispatcher.reset();  // ends its threads
}

}  // namespace

// The format of ioconfig.xml that this module reads. By this function `indurop check` knows that the property config
// names such a file.
extern "C" [[gnu::visibility("default")]] int indurop_io_format() {
  return 1;
}

INDUROP_MODULE(run = &::on_run, start = &::on_start, stop = &::on_stop, name = "iodispat",
               description = "shared variables from and to field devices", license = "Apache-2.0")
