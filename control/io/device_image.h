// SPDX-License-Identifier: Apache-2.0
// The process image of one device, and the conversion of values between it and the driver: scaling, and the substitute
// for a bad value. No threads, no shared variables. Real-time safe after construction.

#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "config/check/io_binding.h"
#include "control/io/driver.h"
#include "control/io/sample.h"
#include "control/io/scaling.h"

namespace indurop::io {

// Values from the device to the variables.
struct InputImage {
  struct Value {
    std::uint64_t bits = 0;  // of the variable
    Quality quality = Quality::None;
    bool is_set = false;  // write it to the variable; false before the first good value
  };
  std::vector<Value> inputs;
  std::vector<Quality> outputs;
  Quality device = Quality::None;
  std::uint64_t errors = 0;  // exchanges that were not good
};

// Values from the variables to the device: the bits of each output's variable.
using OutputImage = std::vector<std::uint64_t>;

class DeviceImage {
 public:
  // The points of each direction, in their order.
  DeviceImage(std::span<const config::BoundPoint> inputs, std::span<const config::BoundPoint> outputs);

  // State of the outputs. Hold: outputs with a stop value get it; the others are not sent.
  enum class Outputs { Unknown, Fresh, Hold };
  // One exchange by the driver, or none if the device is not open; updates the current() image.
  Driver::Outcome exchange(Driver& driver, const OutputImage& outputs, Outputs how, std::chrono::nanoseconds elapsed);
  void lose() noexcept;  // call it if the device could not be opened
  [[nodiscard]] const InputImage& current() const noexcept { return image_; }
  [[nodiscard]] bool has_stop_values() const noexcept;

 private:
  struct Point {
    Scaling scaling;
    std::optional<double> other;  // value of a bad input, stop value of an output
  };
  static std::vector<Point> points_of(std::span<const config::BoundPoint> bound);
  void take_outputs(const OutputImage& outputs, Outputs how) noexcept;
  void give_inputs() noexcept;
  void judge(Driver::Outcome outcome) noexcept;

  std::vector<Point> inputs_;
  std::vector<Point> outputs_;
  std::vector<Sample> input_samples_;
  std::vector<Sample> output_samples_;
  std::vector<bool> not_a_number_;  // outputs of this exchange that are NaN
  InputImage image_;
};

}  // namespace indurop::io
