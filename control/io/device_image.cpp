// SPDX-License-Identifier: Apache-2.0
#include "control/io/device_image.h"

#include <algorithm>
#include <cmath>

namespace indurop::io {

using Outcome = Driver::Outcome;

std::vector<DeviceImage::Point> DeviceImage::points_of(std::span<const config::BoundPoint> bound) {
  std::vector<Point> points;
  for (const config::BoundPoint& b : bound) {
    points.push_back(
        {{b.variable.type.base, b.point.scale, b.point.offset}, b.point.output ? b.point.stop : b.point.bad_value});
  }
  return points;
}

DeviceImage::DeviceImage(std::span<const config::BoundPoint> inputs, std::span<const config::BoundPoint> outputs)
    : inputs_(points_of(inputs)),
      outputs_(points_of(outputs)),
      input_samples_(inputs.size()),
      output_samples_(outputs.size()),
      not_a_number_(outputs.size()) {
  image_.inputs.resize(inputs.size());
  image_.outputs.resize(outputs.size());
}

bool DeviceImage::has_stop_values() const noexcept {
  return std::any_of(outputs_.begin(), outputs_.end(), [](const Point& p) { return p.other.has_value(); });
}

void DeviceImage::take_outputs(const OutputImage& outputs, Outputs how) noexcept {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Point& point = outputs_[i];
    Sample& sample = output_samples_[i];
    not_a_number_[i] = false;
    if (how == Outputs::Hold) {
      sample.quality = point.other ? Quality::Good : Quality::NotRefreshed;
      if (point.other) {
        sample.value = (static_cast<Number>(*point.other) - static_cast<Number>(point.scaling.offset)) /
                       static_cast<Number>(point.scaling.scale);
      }
      continue;
    }
    sample.quality = how == Outputs::Fresh ? Quality::Good : Quality::None;
    if (how == Outputs::Fresh) {
      const Number wanted = from_variable(point.scaling, outputs[i]);
      not_a_number_[i] = std::isnan(wanted);
      sample.value = not_a_number_[i] ? sample.value : wanted;  // the device keeps the last number
    }
  }
}

void DeviceImage::give_inputs() noexcept {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Point& point = inputs_[i];
    const Sample& sample = input_samples_[i];
    InputImage::Value& value = image_.inputs[i];
    value.quality = sample.quality;
    if (sample.quality == Quality::Good && std::isfinite(sample.value)) {
      value.quality = to_variable(point.scaling, sample.value, value.bits) ? Quality::Good : Quality::OutOfRange;
      value.is_set = true;
      continue;
    }
    // NaN and infinite values have no nearest value.
    value.quality = sample.quality == Quality::Good ? Quality::OutOfRange : sample.quality;
    if (point.other) {
      (void)to_variable(point.scaling.base, static_cast<Number>(*point.other), value.bits);
      value.is_set = true;
    }
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Quality quality = output_samples_[i].quality;
    image_.outputs[i] = quality == Quality::Good && not_a_number_[i] ? Quality::OutOfRange : quality;
  }
}

void DeviceImage::judge(Outcome outcome) noexcept {
  if (outcome == Outcome::Good) {
    image_.device = Quality::Good;
    return;
  }
  ++image_.errors;
  const auto any = [this](Quality quality) {
    const auto has = [quality](const Sample& sample) { return sample.quality == quality; };
    return std::any_of(input_samples_.begin(), input_samples_.end(), has) ||
           std::any_of(output_samples_.begin(), output_samples_.end(), has);
  };
  const bool lost = outcome == Outcome::Lost || outcome == Outcome::Failed || any(Quality::Lost);
  const bool reported = !any(Quality::Refused) && any(Quality::Reported);
  image_.device = lost ? Quality::Lost : reported ? Quality::Reported : Quality::Refused;
}

Outcome DeviceImage::exchange(Driver& driver, const OutputImage& outputs, Outputs how,
                              std::chrono::nanoseconds elapsed) {
  take_outputs(outputs, how);
  const Outcome outcome = driver.exchange(output_samples_, input_samples_, elapsed);
  judge(outcome);
  give_inputs();
  return outcome;
}

void DeviceImage::lose() noexcept {
  for (Sample& sample : input_samples_) {
    sample.quality = Quality::Lost;
  }
  for (Sample& sample : output_samples_) {
    sample.quality = Quality::Lost;
  }
  judge(Outcome::Lost);
  give_inputs();
}

}  // namespace indurop::io
