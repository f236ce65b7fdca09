// SPDX-License-Identifier: Apache-2.0
// An instance of an FMU of FMI 2.0, as a master of tests holds it.

#pragma once

#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/integration/fmi/fmu.h"
#include "tests/integration/fmi/master.h"

namespace indurop::fmi {

class Running2 {
 public:
  // An FMU that is not unpacked yet has no library: `message` says why.
  explicit Running2(const Fmu& fmu, const std::string& guid = {}, const std::string& uri = {}) : fmu_(fmu) {
    const char* const missing = open_master2(&master, fmu.library().c_str());
    EXPECT_EQ(missing, nullptr) << missing << fmu.message();
    if (missing != nullptr) {
      return;
    }
    const fmi2CallbackFunctions functions{&note, nullptr, nullptr, nullptr, this};
    instance = master.instantiate("test", fmi2CoSimulation, guid.empty() ? fmu.token().c_str() : guid.c_str(),
                                  uri.empty() ? fmu.uri().c_str() : uri.c_str(), &functions, fmi2False, fmi2False);
  }
  Running2(const Running2&) = delete;
  Running2& operator=(const Running2&) = delete;
  ~Running2() {
    if (instance != nullptr) {
      master.free_instance(instance);
    }
  }

  void initialize(double start = 0) {
    ASSERT_NE(instance, nullptr) << log;
    ASSERT_EQ(master.set_up(instance, fmi2False, 0, start, fmi2False, 0), fmi2OK) << log;
    ASSERT_EQ(master.enter_initialization(instance), fmi2OK) << log;
    ASSERT_EQ(master.exit_initialization(instance), fmi2OK) << log;
  }
  [[nodiscard]] fmi2Status step(double at, double size) { return master.step(instance, at, size, fmi2True); }
  // Returns a Real, Integer or Boolean.
  [[nodiscard]] double get(const std::string& name) {
    const Described* const one = fmu_.find(name);
    EXPECT_NE(one, nullptr) << name;
    if (one == nullptr) {
      return 0;
    }
    double real = 0;
    int whole = 0;
    const fmi2Status status = one->type == "Real"      ? master.get_real(instance, &one->reference, 1, &real)
                              : one->type == "Boolean" ? master.get_boolean(instance, &one->reference, 1, &whole)
                                                       : master.get_integer(instance, &one->reference, 1, &whole);
    EXPECT_EQ(status, fmi2OK) << log;
    return one->type == "Real" ? real : whole;
  }
  [[nodiscard]] fmi2Status set_real(const std::string& name, double value) {
    const unsigned int reference = fmu_.reference(name);
    return master.set_real(instance, &reference, 1, &value);
  }

  Master2 master{};
  fmi2Component instance = nullptr;
  std::string log;  // one line for each message

 private:
  static void note(void* environment, fmi2String instance, fmi2Status status, fmi2String category, fmi2String message,
                   ...) {
    char text[4096];
    std::va_list arguments;
    va_start(arguments, message);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"  // it comes from the FMU
    std::vsnprintf(text, sizeof text, message, arguments);
#pragma GCC diagnostic pop
    va_end(arguments);
    static_cast<Running2*>(environment)->log +=
        std::string(instance) + " " + std::to_string(status) + " " + category + ": " + text + "\n";
  }

  const Fmu& fmu_;
};

}  // namespace indurop::fmi
