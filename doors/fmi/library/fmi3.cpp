// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 3.0 that co-simulation needs, but for those of variables.
#include "control/io/fmu/fmi3.h"

#include <string>

#include "doors/fmi/library/border.h"

namespace indurop::fmi {
namespace {

template <class Act>
fmi3Status call3(fmi3Instance c, const char* function, Act act) noexcept {
  return static_cast<fmi3Status>(at_border(c, function, act));
}

Logger logger3(fmi3InstanceEnvironment environment, fmi3LogMessageCallback callback) {
  return [environment, callback](Outcome severity, const char* category, const std::string& text) {
    if (callback != nullptr) {
      callback(environment, static_cast<fmi3Status>(severity), category, text.c_str());
    }
  };
}

// Says that the FMU is not of this kind.
fmi3Instance not_this_kind(fmi3InstanceEnvironment environment, fmi3LogMessageCallback callback) noexcept {
  try {
    logger3(environment, callback)(Outcome::Error, category_of(Outcome::Error),
                                   "the FMU is one for co-simulation only");
  } catch (...) {  // memory is exhausted
  }
  return nullptr;
}

}  // namespace
}  // namespace indurop::fmi

using namespace indurop::fmi;  // NOLINT(google-build-using-namespace): C has no namespaces

const char* fmi3GetVersion() {
  return "3.0";
}

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]) {
  return call3(c, "fmi3SetDebugLogging",
               [=](Instance& instance) { return instance.set_logging(on, texts_of(categories, count)); });
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String /*name*/, fmi3String /*token*/, fmi3String /*resources*/,
                                          fmi3Boolean /*visible*/, fmi3Boolean /*logging*/,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  return not_this_kind(environment, log);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String /*name*/, fmi3String /*token*/, fmi3String /*resources*/,
                                               fmi3Boolean /*visible*/, fmi3Boolean /*logging*/,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback /*update*/, fmi3LockPreemptionCallback /*lock*/,
                                               fmi3UnlockPreemptionCallback /*unlock*/) {
  return not_this_kind(environment, log);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String /*name*/, fmi3String token, fmi3String resources,
                                         fmi3Boolean /*visible*/, fmi3Boolean logging, fmi3Boolean event_mode,
                                         fmi3Boolean /*early_return*/, const fmi3ValueReference /*intermediate*/[],
                                         size_t intermediate_count, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback /*update*/) {
  try {
    const Logger logger = logger3(environment, log);
    if (event_mode || intermediate_count > 0) {
      logger(Outcome::Error, category_of(Outcome::Error),
             "the FMU has neither an event mode nor intermediate updates (hasEventMode, providesIntermediateUpdate)");
      return nullptr;
    }
    return instantiate(resources == nullptr ? "" : resources, token, logging, logger);
  } catch (...) {  // memory is exhausted
    return nullptr;
  }
}

void fmi3FreeInstance(fmi3Instance c) {
  delete static_cast<Instance*>(c);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean /*has_tolerance*/, fmi3Float64 /*tolerance*/,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop) {
  return call3(c, "fmi3EnterInitializationMode", [=](Instance& instance) {
    auto done = instance.set_up(start, has_stop ? std::optional(stop) : std::nullopt);
    return done ? instance.enter_initialization() : done;
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return call3(c, "fmi3ExitInitializationMode", [](Instance& instance) { return instance.exit_initialization(); });
}

fmi3Status fmi3Terminate(fmi3Instance c) {
  return call3(c, "fmi3Terminate", [](Instance& instance) { return instance.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance c) {
  return call3(c, "fmi3Reset", [](Instance& instance) { return instance.reset(); });
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 at, fmi3Float64 size, fmi3Boolean /*never_goes_back*/,
                      fmi3Boolean* event_needed, fmi3Boolean* terminate, fmi3Boolean* early_return,
                      fmi3Float64* last_time) {
  return call3(c, "fmi3DoStep", [=](Instance& instance) {
    if (event_needed == nullptr || terminate == nullptr || early_return == nullptr || last_time == nullptr) {
      return refused("a result has no place: a null pointer");
    }
    auto done = instance.step(at, size);
    *event_needed = false;
    *terminate = false;
    *early_return = false;
    *last_time = instance.time();
    return done;
  });
}
