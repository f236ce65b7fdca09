// SPDX-License-Identifier: Apache-2.0
// A model instead of a device: an FMU of another tool, which advances by the time of the schedule in each exchange. For
// simulations only: an FMU may allocate and wait.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/io/driver.h"
#include "control/io/fmu/description.h"
#include "control/io/fmu_folder.h"
#include "control/io/fmu_instance.h"

namespace indurop::io {

class FmuDriver final : public Driver {
 public:
  // Errors: the FMU cannot be read.
  static Result<std::unique_ptr<FmuDriver>, std::vector<base::Diagnostic>> make(
      const config::IoDevice& device, std::span<const config::IoPoint> outputs,
      std::span<const config::IoPoint> inputs);
  // The points are those that were bound to `description`.
  FmuDriver(const config::IoDevice& device, fmu::Description description, std::span<const config::IoPoint> outputs,
            std::span<const config::IoPoint> inputs);

  [[nodiscard]] bool in_tick() const noexcept override { return true; }
  bool open() override;
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void add_texts(std::span<const config::IoPoint> points) override;
  [[nodiscard]] std::span<std::string> texts() noexcept override { return texts_; }
  void close() noexcept override;
  [[nodiscard]] std::string problem() const override { return problem_; }

 private:
  // A variable of the FMU that points use.
  struct Used {
    std::size_t variable = 0;      // index into the description
    std::vector<Number> values{};  // of all its elements
    bool is_new = true;            // to be set
  };
  struct Place {
    std::size_t used = 0;
    std::size_t element = 0;
  };
  struct TextPoint {
    std::size_t variable = 0;  // index into the description
    bool output = false;
    std::optional<std::string> sent{};
  };
  static Place place_of(const fmu::Description& description, const std::string& at, std::vector<Used>& all);
  bool set_starts();
  void take(std::span<Sample> outputs);
  bool set_outputs();
  bool set_texts();
  bool advance(std::chrono::nanoseconds elapsed);
  bool read(std::span<Sample> inputs);
  bool fail(const std::string& what);

  config::IoDevice device_;
  fmu::Description description_;
  std::vector<Used> sent_;
  std::vector<Used> read_;
  std::vector<Place> outputs_;  // of the points
  std::vector<Place> inputs_;
  std::vector<TextPoint> text_points_;
  std::vector<std::string> texts_;  // of these points
  std::optional<FmuFolder> folder_;
  std::unique_ptr<FmuLog> log_;
  std::unique_ptr<FmuInstance> instance_;
  std::chrono::nanoseconds time_{0};
  std::chrono::nanoseconds period_{0};  // 0: before the first exchange
  bool is_inside_ = false;              // code of the FMU runs; stays set if a crash or an exception has left it
  std::string problem_;
};

}  // namespace indurop::io
