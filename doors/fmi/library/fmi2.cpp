// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 2.0 that co-simulation needs.
#include "control/io/fmu/fmi2.h"

#include <string>

#include "doors/fmi/library/border.h"
#include "doors/fmi/library/resources.h"

namespace indurop::fmi {
namespace {

template <class Act>
fmi2Status call2(fmi2Component c, const char* function, Act act) noexcept {
  return static_cast<fmi2Status>(at_border(c, function, act));
}

template <class T>
fmi2Status get2(fmi2Component c, const char* function, std::uint32_t allowed, const fmi2ValueReference* refs,
                std::size_t count, T* values) noexcept {
  return call2(c, function, [=](Instance& instance) {
    return with_arrays(refs, count, values, [&](auto references) { return instance.get(allowed, references, values); });
  });
}

template <class T>
fmi2Status set2(fmi2Component c, const char* function, std::uint32_t allowed, const fmi2ValueReference* refs,
                std::size_t count, const T* values) noexcept {
  return call2(c, function, [=](Instance& instance) {
    return with_arrays(refs, count, values, [&](auto references) { return instance.set(allowed, references, values); });
  });
}

// Copies the callbacks: the master may free its own.
Logger logger2(const fmi2CallbackFunctions* functions, fmi2String name) {
  const fmi2CallbackFunctions all = functions == nullptr ? fmi2CallbackFunctions{} : *functions;
  return [all, instance = std::string(name == nullptr ? "" : name)](Outcome severity, const char* category,
                                                                    const std::string& text) {
    if (all.logger != nullptr) {
      all.logger(all.componentEnvironment, instance.c_str(), static_cast<fmi2Status>(severity), category, "%s",
                 text.c_str());
    }
  };
}

// A status that only exists while a step goes on in the background.
fmi2Status no_pending_step(fmi2Component c, const char* function) noexcept {
  return call2(c, function, [](Instance& /*instance*/) -> Done {
    return Trouble{Outcome::Discard, "no step is pending: fmi2DoStep returns when it is done"};
  });
}

}  // namespace
}  // namespace indurop::fmi

using namespace indurop::fmi;  // NOLINT(google-build-using-namespace): C has no namespaces

const char* fmi2GetTypesPlatform() {
  return "default";
}

const char* fmi2GetVersion() {
  return "2.0";
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
  return call2(c, "fmi2SetDebugLogging",
               [=](Instance& instance) { return instance.set_logging(on != fmi2False, texts_of(categories, count)); });
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* functions, fmi2Boolean /*visible*/, fmi2Boolean logging) {
  try {
    const Logger logger = logger2(functions, name);
    if (type != fmi2CoSimulation) {
      logger(Outcome::Error, category_of(Outcome::Error), "fmi2Instantiate: the FMU is one for co-simulation only");
      return nullptr;
    }
    return instantiate(path_of_uri(resources == nullptr ? "" : resources), guid, logging != fmi2False, logger);
  } catch (...) {  // memory is exhausted
    return nullptr;
  }
}

void fmi2FreeInstance(fmi2Component c) {
  delete static_cast<Instance*>(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean /*has_tolerance*/, fmi2Real /*tolerance*/, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
  return call2(c, "fmi2SetupExperiment", [=](Instance& instance) {
    return instance.set_up(start, has_stop != fmi2False ? std::optional(stop) : std::nullopt);
  });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return call2(c, "fmi2EnterInitializationMode", [](Instance& instance) { return instance.enter_initialization(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return call2(c, "fmi2ExitInitializationMode", [](Instance& instance) { return instance.exit_initialization(); });
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return call2(c, "fmi2Terminate", [](Instance& instance) { return instance.terminate(); });
}

fmi2Status fmi2Reset(fmi2Component c) {
  return call2(c, "fmi2Reset", [](Instance& instance) { return instance.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference refs[], size_t count, fmi2Real values[]) {
  return get2(c, "fmi2GetReal", kReals, refs, count, values);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference refs[], size_t count, fmi2Integer values[]) {
  return get2(c, "fmi2GetInteger", kIntegers, refs, count, values);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference refs[], size_t count, fmi2Boolean values[]) {
  return get2(c, "fmi2GetBoolean", kBooleans, refs, count, values);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference refs[], size_t count, fmi2String values[]) {
  return call2(c, "fmi2GetString", [=](Instance& instance) {
    return with_arrays(refs, count, values, [&](auto references) { return instance.get_texts(references, values); });
  });
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference refs[], size_t count, const fmi2Real values[]) {
  return set2(c, "fmi2SetReal", kReals, refs, count, values);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference refs[], size_t count, const fmi2Integer values[]) {
  return set2(c, "fmi2SetInteger", kIntegers, refs, count, values);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference refs[], size_t count, const fmi2Boolean values[]) {
  return set2(c, "fmi2SetBoolean", kBooleans, refs, count, values);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference refs[], size_t count, const fmi2String values[]) {
  return call2(c, "fmi2SetString", [=](Instance& instance) {
    return with_arrays(refs, count, values, [&](auto references) { return instance.set_texts(references, values); });
  });
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real at, fmi2Real size, fmi2Boolean /*never_goes_back*/) {
  return call2(c, "fmi2DoStep", [=](Instance& instance) { return instance.step(at, size); });
}

fmi2Status fmi2CancelStep(fmi2Component c) {
  return call2(c, "fmi2CancelStep", [](Instance& /*instance*/) {
    return refused("no step is pending: fmi2DoStep returns when it is done");
  });
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind /*kind*/, fmi2Status* /*value*/) {
  return no_pending_step(c, "fmi2GetStatus");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  return call2(c, "fmi2GetRealStatus", [=](Instance& instance) -> Done {
    if (kind != fmi2LastSuccessfulTime || value == nullptr) {
      return Trouble{Outcome::Discard, "only fmi2LastSuccessfulTime is a real number"};
    }
    *value = instance.time();
    return {};
  });
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind /*kind*/, fmi2Integer* /*value*/) {
  return no_pending_step(c, "fmi2GetIntegerStatus");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* value) {
  return call2(c, "fmi2GetBooleanStatus", [=](Instance& instance) -> Done {
    if (kind != fmi2Terminated || value == nullptr) {
      return Trouble{Outcome::Discard, "only fmi2Terminated is true or false"};
    }
    *value = instance.mode() == Mode::Failed ? fmi2True : fmi2False;
    return {};
  });
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind /*kind*/, fmi2String* /*value*/) {
  return no_pending_step(c, "fmi2GetStringStatus");
}
