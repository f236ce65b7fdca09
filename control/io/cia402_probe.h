// SPDX-License-Identifier: Apache-2.0
// One of a drive's two touch probes (IEC 61800-7-201, objects 0x60B8 to 0x60BD): stores the position of the axis when
// an input changed or the encoder's mark passed. Real-time safe.

#pragma once

#include <cstdint>
#include <optional>

namespace indurop::io {

// One step of an axis, input of a probe. Degrees.
struct ProbeStep {
  double before = 0;
  double now = 0;
  std::optional<double> input_at;  // the input is on from this position
  double mark_at = 0;              // position of a mark; there is one in every turn
};

class TouchProbe {
 public:
  // Sets the probe's eight bits of the function object: 0 on, 1 every time (else the first), 2 the mark (else the
  // input), 4 edge to on, 5 edge to off.
  void take(std::uint8_t function) noexcept;
  void step(const ProbeStep& step) noexcept;

  // Returns the probe's bits of the status object: 0 on, 1 an edge to on was stored, 2 an edge to off was stored.
  [[nodiscard]] std::uint8_t status() const noexcept;
  // Position of the last stored edge, degrees.
  [[nodiscard]] double rise() const noexcept { return rise_; }
  [[nodiscard]] double fall() const noexcept { return fall_; }

 private:
  void store(double at, bool rising) noexcept;

  std::uint8_t function_ = 0;
  bool has_rise_ = false;
  bool has_fall_ = false;
  double rise_ = 0;
  double fall_ = 0;
};

}  // namespace indurop::io
