// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 2.0 for what the model description does not offer: each says why.
#include "control/io/fmu/fmi2.h"
#include "doors/fmi/library/border.h"

namespace indurop::fmi {
namespace {

constexpr const char* kNoStates = "states are not saved (canGetAndSetFMUstate is false)";
constexpr const char* kNoSerializedStates = "states are not saved (canSerializeFMUstate is false)";
constexpr const char* kNoDerivatives = "there are no derivatives (providesDirectionalDerivative is false)";
constexpr const char* kNoExchange = "the FMU is one for co-simulation only";

fmi2Status refuse2(fmi2Component c, const char* function, const char* why) noexcept {
  return static_cast<fmi2Status>(at_border(c, function, [why](Instance& /*instance*/) { return refused(why); }));
}

}  // namespace
}  // namespace indurop::fmi

using namespace indurop::fmi;  // NOLINT(google-build-using-namespace): C has no namespaces

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* /*state*/) {
  return refuse2(c, "fmi2GetFMUstate", kNoStates);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate /*state*/) {
  return refuse2(c, "fmi2SetFMUstate", kNoStates);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* /*state*/) {
  return refuse2(c, "fmi2FreeFMUstate", kNoStates);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate /*state*/, size_t* /*size*/) {
  return refuse2(c, "fmi2SerializedFMUstateSize", kNoSerializedStates);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate /*state*/, fmi2Byte /*bytes*/[], size_t /*size*/) {
  return refuse2(c, "fmi2SerializeFMUstate", kNoSerializedStates);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte /*bytes*/[], size_t /*size*/,
                                   fmi2FMUstate* /*state*/) {
  return refuse2(c, "fmi2DeSerializeFMUstate", kNoSerializedStates);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference /*unknowns*/[],
                                        size_t /*unknown_count*/, const fmi2ValueReference /*knowns*/[],
                                        size_t /*known_count*/, const fmi2Real /*known_steps*/[],
                                        fmi2Real /*unknown_steps*/[]) {
  return refuse2(c, "fmi2GetDirectionalDerivative", kNoDerivatives);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference /*refs*/[], size_t /*count*/,
                                       const fmi2Integer /*orders*/[], const fmi2Real /*values*/[]) {
  return refuse2(c, "fmi2SetRealInputDerivatives", "inputs are not interpolated (canInterpolateInputs is false)");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference /*refs*/[], size_t /*count*/,
                                        const fmi2Integer /*orders*/[], fmi2Real /*values*/[]) {
  return refuse2(c, "fmi2GetRealOutputDerivatives", "outputs have no derivatives (maxOutputDerivativeOrder is 0)");
}

fmi2Status fmi2EnterEventMode(fmi2Component c) {
  return refuse2(c, "fmi2EnterEventMode", kNoExchange);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo* /*info*/) {
  return refuse2(c, "fmi2NewDiscreteStates", kNoExchange);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return refuse2(c, "fmi2EnterContinuousTimeMode", kNoExchange);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean /*never_goes_back*/, fmi2Boolean* /*event_mode*/,
                                       fmi2Boolean* /*terminate*/) {
  return refuse2(c, "fmi2CompletedIntegratorStep", kNoExchange);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real /*time*/) {
  return refuse2(c, "fmi2SetTime", kNoExchange);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real /*states*/[], size_t /*count*/) {
  return refuse2(c, "fmi2SetContinuousStates", kNoExchange);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real /*derivatives*/[], size_t /*count*/) {
  return refuse2(c, "fmi2GetDerivatives", kNoExchange);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real /*indicators*/[], size_t /*count*/) {
  return refuse2(c, "fmi2GetEventIndicators", kNoExchange);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real /*states*/[], size_t /*count*/) {
  return refuse2(c, "fmi2GetContinuousStates", kNoExchange);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real /*nominals*/[], size_t /*count*/) {
  return refuse2(c, "fmi2GetNominalsOfContinuousStates", kNoExchange);
}
