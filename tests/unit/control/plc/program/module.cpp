// SPDX-License-Identifier: Apache-2.0
#include "module.h"

#include <indurop/irp.h>
#include <indurop/module.h>

#include <dlfcn.h>

#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace {
std::int64_t time_of_test = 0;

// A node named "local" may be running on this machine; a generated header looks for it at priority 101.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wprio-ctor-dtor"
[[gnu::constructor(100)]] void keep_away_from_others() {
  ::setenv("INDUROP_NODE", "plctest-none", 0);
}
#pragma GCC diagnostic pop
}  // namespace

// Instead of the one in libindurop.so.
std::int64_t irp::release_ns() noexcept {
  return time_of_test;
}

namespace indurop::testing {

PlcModule::PlcModule(const std::string& name)
    : library_(::dlopen((std::string(PLC_MODULES) + "/" + name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr) {
    throw std::runtime_error(::dlerror());
  }
  ModuleDescriptor descriptor;
  reinterpret_cast<void (*)(ModuleDescriptor*)>(::dlsym(library_, "indurop_module_describe"))(&descriptor);
  run_ = descriptor.run;
  condition_ = descriptor.condition.as_bool;
}

PlcModule::~PlcModule() {
  ::dlclose(library_);
}

void PlcModule::scan(std::chrono::nanoseconds at) const {
  time_of_test = at.count();
  run_();
}

bool PlcModule::due() const {
  return condition_();
}

std::string PlcModule::fault() const {
  try {
    scan();
  } catch (const std::exception& thrown) {
    return thrown.what();
  }
  return "";
}

}  // namespace indurop::testing
