// SPDX-License-Identifier: Apache-2.0
// Everything between an ioconfig.xml and the run of a module: variables, images, devices. run() is the one point of the
// tick at which the process image is copied.

#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/check/io_binding.h"
#include "io/device_image.h"
#include "io/exchange_thread.h"
#include "io/variables.h"

namespace indurop::io {

// Which points one run copies: two modules with the same file can split them.
enum class Phase { Both, Inputs, Outputs };

class Dispatcher {
 public:
  struct Made;
  // `schema`: the node's variables. Not real-time safe.
  static Made make(const std::filesystem::path& file, const schema::Schema& schema, Phase phase);
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;
  ~Dispatcher();

  // Binds the variables, starts the threads of devices that need one; their messages are those of module `module`. Not
  // real-time safe. Errors: NoSpace, System.
  Status start(std::uint32_t module);
  // Takes the outputs from their variables, exchanges with devices that live in the tick, and gives the inputs to
  // theirs. Real-time safe. `elapsed`: since the run before.
  void run(std::chrono::nanoseconds elapsed) noexcept;
  // Not real-time safe.
  void stop();

 private:
  // A whole number about a point or a device.
  struct Report {
    std::size_t part;  // in variables_
    schema::Base base;
  };
  // One device with the variables of its points, as numbers in `variables_`.
  struct Line {
    config::IoDevice device;
    std::unique_ptr<Driver> driver;
    std::optional<DeviceImage> in_tick;
    std::unique_ptr<ExchangeThread> thread;  // if it is not in the tick
    OutputImage outputs;                     // of a device in the tick
    std::vector<std::size_t> from;           // of the outputs
    std::vector<std::size_t> to;             // of the inputs
    std::vector<std::optional<Report>> input_qualities;
    std::vector<std::optional<Report>> output_qualities;
    std::optional<Report> quality;
    std::optional<Report> errors;
  };
  Dispatcher() = default;
  // Returns what is wrong with the device.
  std::vector<base::Diagnostic> add(const config::BoundDevice& bound, Phase phase, const std::filesystem::path& file);
  std::optional<Report> report_to(const std::optional<schema::Place>& variable);
  void take(Line& line, OutputImage& into) noexcept;
  void give(const Line& line, const InputImage& image) noexcept;
  void tell(const std::optional<Report>& to, Quality quality) noexcept;

  Variables variables_;
  std::deque<Line> lines_;
};

struct Dispatcher::Made {
  std::unique_ptr<Dispatcher> dispatcher;     // null if the file cannot be used
  std::vector<base::Diagnostic> diagnostics;  // everything that is wrong or worth a note
};

}  // namespace indurop::io
