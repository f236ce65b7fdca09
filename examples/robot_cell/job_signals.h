// SPDX-License-Identifier: Apache-2.0
// The shared variables that jobs set and wait for, by name. All are numbers of 16 bits like the PLC's points I0 and O0;
// name them in <access> of module.xml, so that the checks know them.
#pragma once

#include <indurop/channel.h>
#include <indurop/robot/controller.h>

#include <stdexcept>
#include <string>
#include <vector>

class JobSignals final : public indurop::robot::Signals {
 public:
  // The first access by a name looks it up, the others are real-time safe.
  explicit JobSignals(const std::vector<std::string>& names) : names_(names) {
    for (const std::string& name : names_) {
      if (!channel::read<short>(handle_, name).ok()) {
        throw std::runtime_error("a job names the variable " + name + ", which is no short of this node");
      }
    }
  }
  double read(std::size_t index) noexcept override {
    const auto value = channel::read<short>(handle_, names_[index]);
    return value.ok() ? value.value() : 0;
  }
  void write(std::size_t index, double value) noexcept override {
    static_cast<void>(channel::write(handle_, names_[index], static_cast<short>(value)));
  }

 private:
  channel::Handle handle_;
  std::vector<std::string> names_;
};
