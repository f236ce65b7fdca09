// SPDX-License-Identifier: Apache-2.0
#include "control/io/fmu_driver.h"

#include <fmt/format.h>
#include <indurop/irp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "control/io/fmu/fmu_file.h"
#include "control/io/number.h"

namespace indurop::io {

namespace {

double seconds(std::chrono::nanoseconds time) {
  constexpr double kNanos = 1e9;
  return static_cast<double>(time.count()) / kNanos;
}

// The nearest number that a type has.
template <class T>
Number nearest(Number value) {
  T whole{};
  (void)to_whole(value, whole);
  return static_cast<Number>(whole);
}

Number nearest_of(const fmu::Variable& variable, Number value) {
  if (variable.min) {
    value = std::max(value, static_cast<Number>(*variable.min));
  }
  if (variable.max) {
    value = std::min(value, static_cast<Number>(*variable.max));
  }
  float small = 0;
  double real = 0;
  switch (variable.type) {
    case fmu::Type::Float32:
      (void)to_real(value, small);
      return small;
    case fmu::Type::Float64:
      (void)to_real(value, real);
      return static_cast<Number>(real);
    case fmu::Type::Int8:
      return nearest<std::int8_t>(value);
    case fmu::Type::UInt8:
      return nearest<std::uint8_t>(value);
    case fmu::Type::Int16:
      return nearest<std::int16_t>(value);
    case fmu::Type::UInt16:
      return nearest<std::uint16_t>(value);
    case fmu::Type::Int32:
      return nearest<std::int32_t>(value);
    case fmu::Type::UInt32:
      return nearest<std::uint32_t>(value);
    case fmu::Type::Int64:
    case fmu::Type::Enumeration:
      return nearest<std::int64_t>(value);
    case fmu::Type::UInt64:
      return nearest<std::uint64_t>(value);
    case fmu::Type::Boolean:
      return value != 0 ? 1 : 0;
    case fmu::Type::String:
    case fmu::Type::Binary:
    case fmu::Type::Clock:
      break;
  }
  return value;
}

// A number is limited, not rounded, to become another one.
bool is_limited(const fmu::Variable& variable, Number value, Number nearest) {
  const bool is_real = variable.type == fmu::Type::Float32 || variable.type == fmu::Type::Float64;
  return variable.type != fmu::Type::Boolean &&
         std::fabs(value - nearest) > (is_real ? std::fabs(value) * 1e-6L : 0.5L);
}

}  // namespace

Result<std::unique_ptr<FmuDriver>, std::vector<base::Diagnostic>> FmuDriver::make(
    const config::IoDevice& device, std::span<const config::IoPoint> outputs, std::span<const config::IoPoint> inputs) {
  fmu::FmuFile file = fmu::read_fmu(device.fmu.file);
  if (!file.ok()) {
    return std::move(file.diagnostics);
  }
  return std::make_unique<FmuDriver>(device, std::move(file.description), outputs, inputs);
}

FmuDriver::FmuDriver(const config::IoDevice& device, fmu::Description description,
                     std::span<const config::IoPoint> outputs, std::span<const config::IoPoint> inputs)
    : device_(device), description_(std::move(description)) {
  for (const config::IoPoint& point : outputs) {
    outputs_.push_back(place_of(description_, point.at, sent_));
  }
  for (const config::IoPoint& point : inputs) {
    inputs_.push_back(place_of(description_, point.at, read_));
  }
}

FmuDriver::Place FmuDriver::place_of(const fmu::Description& description, const std::string& at,
                                     std::vector<Used>& all) {
  const fmu::Place place = fmu::find_place(description, at).value_or(fmu::Place{});
  const auto found =
      std::find_if(all.begin(), all.end(), [&place](const Used& used) { return used.variable == place.variable; });
  if (found != all.end()) {
    return {static_cast<std::size_t>(found - all.begin()), place.element};
  }
  const fmu::Variable& variable = description.variables[place.variable];
  Used& used = all.emplace_back(Used{place.variable});
  used.values.resize(variable.size());
  for (std::size_t i = 0; i < used.values.size() && !variable.start.empty(); ++i) {
    const std::string& start = variable.start[i < variable.start.size() ? i : 0];
    used.values[i] = fmu::read_number(variable, start).value_or(0);
  }
  return {all.size() - 1, place.element};
}

void FmuDriver::add_texts(std::span<const config::IoPoint> points) {
  for (const config::IoPoint& point : points) {
    const fmu::Place place = fmu::find_place(description_, point.at).value_or(fmu::Place{});
    text_points_.push_back({place.variable, point.output});
  }
  texts_.resize(points.size());
}

bool FmuDriver::fail(const std::string& what) {
  problem_ = fmt::format("{} ({}) at {} s: {}", device_.name, device_.fmu.as_written, seconds(time_), what);
  return false;
}

bool FmuDriver::open() {
  auto folder = FmuFolder::unpack(device_.fmu.file);
  if (!folder) {
    return fail(folder.error());
  }
  folder_.emplace(std::move(folder).value());
  log_ = std::make_unique<FmuLog>(
      [name = device_.name](const std::string& text) { irp::printf("%s: %s\n", name, text); }, device_.fmu.log);
  is_inside_ = true;
  auto made = FmuInstance::make(description_, {device_.name, folder_->path()}, *log_);
  if (!made) {
    is_inside_ = false;
    return fail(made.error());
  }
  instance_ = std::move(made).value();
  const bool done = set_starts() && instance_->enter_initialization();
  is_inside_ = false;
  return done || fail(instance_->problem());
}

bool FmuDriver::set_starts() {
  for (const config::IoFmuStart& start : device_.fmu.starts) {
    const fmu::Place place = fmu::find_place(description_, start.at).value_or(fmu::Place{});
    const fmu::Variable& variable = description_.variables[place.variable];
    if (variable.type == fmu::Type::String) {
      if (!instance_->set_text(variable, start.value)) {
        return false;
      }
      continue;
    }
    // Elements of an array are set together.
    std::vector<Used> one;
    (void)place_of(description_, variable.name, one);
    const auto numbers = fmu::read_numbers(variable, start.value);
    for (std::size_t i = 0; i < one.front().values.size(); ++i) {
      one.front().values[i] = numbers[i < numbers.size() ? i : 0];
    }
    if (!instance_->set(variable, one.front().values)) {
      return false;
    }
    // A point of the same array sends its other elements with it.
    for (Used& used : sent_) {
      used.values = used.variable == place.variable ? one.front().values : used.values;
    }
  }
  return true;
}

Driver::Outcome FmuDriver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                    std::chrono::nanoseconds elapsed) {
  is_inside_ = true;
  take(outputs);
  const bool is_first = period_.count() == 0;
  if (is_first) {
    period_ = elapsed;
  }
  const bool done =
      set_outputs() && set_texts() && (is_first ? instance_->exit_initialization() : advance(elapsed)) && read(inputs);
  is_inside_ = false;
  if (!done && problem_.empty()) {
    fail(instance_->problem());
  }
  return done ? Outcome::Good : Outcome::Failed;
}

void FmuDriver::take(std::span<Sample> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].quality != Quality::Good) {
      continue;
    }
    Used& used = sent_[outputs_[i].used];
    const fmu::Variable& variable = description_.variables[used.variable];
    const Number value = nearest_of(variable, outputs[i].value);
    outputs[i].quality = is_limited(variable, outputs[i].value, value) ? Quality::OutOfRange : Quality::Good;
    Number& sent = used.values[outputs_[i].element];
    used.is_new = used.is_new || sent != value;
    sent = value;
  }
}

// A value that stays is not set again: setting a parameter may be an event.
bool FmuDriver::set_outputs() {
  for (Used& used : sent_) {
    if (std::exchange(used.is_new, false) && !instance_->set(description_.variables[used.variable], used.values)) {
      return false;
    }
  }
  return true;
}

bool FmuDriver::set_texts() {
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    TextPoint& point = text_points_[i];
    if (point.output && point.sent != texts_[i]) {
      point.sent = texts_[i];
      if (!instance_->set_text(description_.variables[point.variable], texts_[i])) {
        return false;
      }
    }
  }
  return true;
}

// In steps of the module's period, also if runs were skipped: many FMUs know steps of one length only.
bool FmuDriver::advance(std::chrono::nanoseconds elapsed) {
  const bool is_multiple = elapsed % period_ == std::chrono::nanoseconds::zero();
  if (!is_multiple && !description_.any_step) {
    return fail(fmt::format("its steps have one length, {} s, and the module's period has changed", seconds(period_)));
  }
  const std::chrono::nanoseconds size = is_multiple ? period_ : elapsed;
  for (const std::chrono::nanoseconds end = time_ + elapsed; time_ < end; time_ += size) {
    if (!instance_->step(seconds(time_), seconds(size))) {
      return false;
    }
  }
  return true;
}

bool FmuDriver::read(std::span<Sample> inputs) {
  for (Used& used : read_) {
    if (!instance_->get(description_.variables[used.variable], used.values)) {
      return false;
    }
  }
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    const TextPoint& point = text_points_[i];
    if (!point.output && !instance_->get_text(description_.variables[point.variable], texts_[i])) {
      return false;
    }
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs[i] = {read_[inputs_[i].used].values[inputs_[i].element], Quality::Good};
  }
  return true;
}

void FmuDriver::close() noexcept {
  // After a crash or an exception the FMU may hold locks or have damaged its memory: it stays until the process ends.
  if (is_inside_) {
    (void)instance_.release();
    (void)log_.release();
  }
  if (instance_ != nullptr) {
    try {
      instance_->end();
    } catch (...) {  // NOLINT(bugprone-empty-catch): the node stops, and nothing is left to be done
    }
  }
  instance_.reset();
  folder_.reset();
}

}  // namespace indurop::io
