// SPDX-License-Identifier: Apache-2.0
// Connects an ioconfig.xml with the runs of a module: variables, images, devices. The process image is copied in run()
// only, once per tick.

#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/check/io_binding.h"
#include "control/io/device_image.h"
#include "control/io/exchange_thread.h"
#include "control/io/variables.h"

namespace indurop::io {

// The points that one run copies: two modules with the same file can split them.
enum class Phase { Both, Inputs, Outputs };

class Dispatcher {
 public:
  struct Made;
  // `schema`: the node's variables. Not real-time safe.
  // `simulated`: makes the wires of a simulation for EtherCAT buses, or says what is wrong; without it they are network
  // interfaces.
  using MakeWires = std::function<Result<EthercatWires, std::vector<base::Diagnostic>>(const config::IoConfig&)>;
  static Made make(const std::filesystem::path& file, const schema::Schema& schema, Phase phase,
                   const MakeWires& simulated = {});
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;
  ~Dispatcher();

  // Binds the variables, opens devices in the tick, and starts the threads of devices that need one; their messages are
  // those of module `module`, which is the caller's. Not real-time safe. Errors: NoSpace, System; problem() may say
  // more.
  Status start(std::uint32_t module);
  // Reads the outputs from their variables, exchanges with devices that work in the tick, and writes the inputs to
  // their variables. Real-time safe. `elapsed`: time since the last run. Returns false if a device cannot go on; then
  // no input was written, and problem() says why.
  bool run(std::chrono::nanoseconds elapsed);
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  // Not real-time safe.
  void stop();

 private:
  // A variable for the quality or error count of a point or a device.
  struct Report {
    std::size_t part;  // index in variables_
    schema::Base base;
  };
  struct Text {
    std::size_t part;  // text in variables_
    bool output;
    std::optional<Report> quality;
  };
  // One device with the variables of its points, as indices in `variables_`.
  struct Line {
    config::IoDevice device;
    std::unique_ptr<Driver> driver;
    std::optional<DeviceImage> in_tick;
    std::unique_ptr<ExchangeThread> thread;  // for a device outside the tick
    OutputImage outputs;                     // for a device in the tick
    std::vector<std::size_t> from;           // variables of the outputs
    std::vector<std::size_t> to;             // variables of the inputs
    std::vector<Text> texts;                 // as the driver has them
    std::vector<std::optional<Report>> input_qualities;
    std::vector<std::optional<Report>> output_qualities;
    std::optional<Report> quality;
    std::optional<Report> errors;
    std::optional<Report> cut;
    std::optional<Report> cable_errors;
  };
  Dispatcher() = default;
  // Returns the errors of the device.
  std::vector<base::Diagnostic> add(const config::BoundDevice& bound, Phase phase, const std::filesystem::path& file);
  void add_texts(Line& line, std::span<const config::BoundPoint> texts);
  std::optional<Report> report_to(const std::optional<schema::Place>& variable);
  void take(Line& line, OutputImage& into) noexcept;
  void give(const Line& line, const InputImage& image) noexcept;
  void take_texts(const Line& line);
  void give_texts(const Line& line);
  void write_quality(const std::optional<Report>& to, Quality quality) noexcept;
  void write_count(const std::optional<Report>& to, std::uint64_t count) noexcept;

  Variables variables_;
  EthercatBuses buses_;
  std::deque<Line> lines_;
  std::string problem_;
};

struct Dispatcher::Made {
  std::unique_ptr<Dispatcher> dispatcher;     // null if the file cannot be used
  std::vector<base::Diagnostic> diagnostics;  // all errors, warnings and notes
};

}  // namespace indurop::io
