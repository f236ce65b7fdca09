// SPDX-License-Identifier: Apache-2.0
// The shared variables that jobs set and read, by name: any number or bool. Name them in <access> of module.xml, so
// that the checks know them.
#pragma once

#include <indurop/channel.h>
#include <indurop/robot/controller.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

class JobSignals final : public indurop::robot::Signals {
 public:
  explicit JobSignals(const std::vector<std::string>& names) {
    if (const auto prepared = prepare(names); !prepared) {
      throw std::runtime_error(prepared.error());
    }
    adopt();
  }
  double read(std::size_t index) noexcept override {
    const Signal& signal = present_->signals[index];
    return signal.read(present_->handle, signal.name);
  }
  // A value that the variable cannot hold becomes the nearest one.
  void write(std::size_t index, double value) noexcept override {
    const Signal& signal = present_->signals[index];
    signal.write(present_->handle, signal.name, value);
  }
  // The first access by a name looks it up, the others are real-time safe.
  indurop::Result<void, std::string> prepare(const std::vector<std::string>& names) override {
    next_ = std::make_unique<Known>();
    std::string unknown;
    for (const std::string& name : names) {
      Signal signal{name, nullptr, nullptr};
      const bool found = is<short>(signal) || is<bool>(signal) || is<std::int32_t>(signal) || is<double>(signal) ||
                         is<std::uint8_t>(signal) || is<std::int8_t>(signal) || is<std::uint16_t>(signal) ||
                         is<std::uint32_t>(signal) || is<std::int64_t>(signal) || is<std::uint64_t>(signal) ||
                         is<float>(signal);
      if (!found) {
        unknown += (unknown.empty() ? "" : ", ") + name;
      }
      next_->signals.push_back(signal);
    }
    if (!unknown.empty()) {
      return "jobs name variables that are no numbers or bools of this node: " + unknown + "; indurop check says where";
    }
    return {};
  }
  // Those before are destroyed when others are prepared.
  void adopt() noexcept override { std::swap(present_, next_); }

 private:
  struct Signal {
    std::string name;
    double (*read)(channel::Handle&, const std::string&) noexcept;
    void (*write)(channel::Handle&, const std::string&, double) noexcept;
  };
  struct Known {
    channel::Handle handle;
    std::vector<Signal> signals;
  };

  template <class T>
  bool is(Signal& signal) {
    if (!channel::read<T>(next_->handle, signal.name).ok()) {
      return false;
    }
    signal.read = [](channel::Handle& handle, const std::string& name) noexcept {
      const auto value = channel::read<T>(handle, name);
      return value.ok() ? static_cast<double>(value.value()) : 0.0;
    };
    signal.write = [](channel::Handle& handle, const std::string& name, double value) noexcept {
      static_cast<void>(channel::write(handle, name, nearest<T>(value)));
    };
    return true;
  }

  template <class T>
  static T nearest(double value) noexcept {
    if constexpr (std::is_same_v<T, bool>) {
      return value != 0;
    } else if constexpr (std::is_floating_point_v<T>) {
      constexpr auto kMaxValue = static_cast<double>(std::numeric_limits<T>::max());
      return static_cast<T>(std::clamp(value, -kMaxValue, kMaxValue));
    } else {
      // The largest whole number may be none that a double can say; then the next one counts as too large.
      const double whole = std::round(value);
      if (!(whole > static_cast<double>(std::numeric_limits<T>::min()))) {
        return std::numeric_limits<T>::min();
      }
      return whole >= static_cast<double>(std::numeric_limits<T>::max()) ? std::numeric_limits<T>::max()
                                                                         : static_cast<T>(whole);
    }
  }

  std::unique_ptr<Known> present_, next_;
};
