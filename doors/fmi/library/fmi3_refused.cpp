// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 3.0 for what the model description does not offer: each says why.
#include "control/io/fmu/fmi3.h"
#include "doors/fmi/library/border.h"

namespace indurop::fmi {
namespace {

constexpr const char* kNoStates3 = "states are not saved (canGetAndSetFMUState is false)";
constexpr const char* kNoSerializedStates3 = "states are not saved (canSerializeFMUState is false)";
constexpr const char* kNoClocks = "there are no clocks";
constexpr const char* kNoEvents = "there is no event mode (hasEventMode is false)";
constexpr const char* kNoOtherKind = "the FMU is one for co-simulation only";

fmi3Status refuse3(fmi3Instance c, const char* function, const char* why) noexcept {
  return static_cast<fmi3Status>(at_border(c, function, [why](Instance& /*instance*/) { return refused(why); }));
}

}  // namespace
}  // namespace indurop::fmi

using namespace indurop::fmi;  // NOLINT(google-build-using-namespace): C has no namespaces

fmi3Status fmi3EnterEventMode(fmi3Instance c) {
  return refuse3(c, "fmi3EnterEventMode", kNoEvents);
}

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/, size_t /*sizes*/[],
                         fmi3Binary /*values*/[], size_t /*value_count*/) {
  return refuse3(c, "fmi3GetBinary", "there are no binary variables");
}

fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/, fmi3Clock /*values*/[]) {
  return refuse3(c, "fmi3GetClock", kNoClocks);
}

fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                         const size_t /*sizes*/[], const fmi3Binary /*values*/[], size_t /*value_count*/) {
  return refuse3(c, "fmi3SetBinary", "there are no binary variables");
}

fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                        const fmi3Clock /*values*/[]) {
  return refuse3(c, "fmi3SetClock", kNoClocks);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference /*ref*/, size_t* /*count*/) {
  return refuse3(c, "fmi3GetNumberOfVariableDependencies",
                 "dependencies are in the model description (providesPerElementDependencies is false)");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference /*dependent*/, size_t /*dependent_indices*/[],
                                       fmi3ValueReference /*independents*/[], size_t /*independent_indices*/[],
                                       fmi3DependencyKind /*kinds*/[], size_t /*count*/) {
  return refuse3(c, "fmi3GetVariableDependencies",
                 "dependencies are in the model description (providesPerElementDependencies is false)");
}

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* /*state*/) {
  return refuse3(c, "fmi3GetFMUState", kNoStates3);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState /*state*/) {
  return refuse3(c, "fmi3SetFMUState", kNoStates3);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* /*state*/) {
  return refuse3(c, "fmi3FreeFMUState", kNoStates3);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState /*state*/, size_t* /*size*/) {
  return refuse3(c, "fmi3SerializedFMUStateSize", kNoSerializedStates3);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState /*state*/, fmi3Byte /*bytes*/[], size_t /*size*/) {
  return refuse3(c, "fmi3SerializeFMUState", kNoSerializedStates3);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte /*bytes*/[], size_t /*size*/,
                                   fmi3FMUState* /*state*/) {
  return refuse3(c, "fmi3DeserializeFMUState", kNoSerializedStates3);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference /*unknowns*/[],
                                        size_t /*unknown_count*/, const fmi3ValueReference /*knowns*/[],
                                        size_t /*known_count*/, const fmi3Float64 /*seed*/[], size_t /*seed_count*/,
                                        fmi3Float64 /*sensitivity*/[], size_t /*sensitivity_count*/) {
  return refuse3(c, "fmi3GetDirectionalDerivative",
                 "there are no derivatives (providesDirectionalDerivatives is false)");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference /*unknowns*/[], size_t /*unknown_count*/,
                                    const fmi3ValueReference /*knowns*/[], size_t /*known_count*/,
                                    const fmi3Float64 /*seed*/[], size_t /*seed_count*/, fmi3Float64 /*sensitivity*/[],
                                    size_t /*sensitivity_count*/) {
  return refuse3(c, "fmi3GetAdjointDerivative", "there are no derivatives (providesAdjointDerivatives is false)");
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) {
  return refuse3(c, "fmi3EnterConfigurationMode", "there are no structural parameters");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) {
  return refuse3(c, "fmi3ExitConfigurationMode", "there are no structural parameters");
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                  fmi3Float64 /*intervals*/[], fmi3IntervalQualifier /*qualifiers*/[]) {
  return refuse3(c, "fmi3GetIntervalDecimal", kNoClocks);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                   fmi3UInt64 /*counters*/[], fmi3UInt64 /*resolutions*/[],
                                   fmi3IntervalQualifier /*qualifiers*/[]) {
  return refuse3(c, "fmi3GetIntervalFraction", kNoClocks);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                               fmi3Float64 /*shifts*/[]) {
  return refuse3(c, "fmi3GetShiftDecimal", kNoClocks);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                fmi3UInt64 /*counters*/[], fmi3UInt64 /*resolutions*/[]) {
  return refuse3(c, "fmi3GetShiftFraction", kNoClocks);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                  const fmi3Float64 /*intervals*/[]) {
  return refuse3(c, "fmi3SetIntervalDecimal", kNoClocks);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                   const fmi3UInt64 /*counters*/[], const fmi3UInt64 /*resolutions*/[]) {
  return refuse3(c, "fmi3SetIntervalFraction", kNoClocks);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                               const fmi3Float64 /*shifts*/[]) {
  return refuse3(c, "fmi3SetShiftDecimal", kNoClocks);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                const fmi3UInt64 /*counters*/[], const fmi3UInt64 /*resolutions*/[]) {
  return refuse3(c, "fmi3SetShiftFraction", kNoClocks);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) {
  return refuse3(c, "fmi3EvaluateDiscreteStates", kNoEvents);
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean* /*need_update*/, fmi3Boolean* /*terminate*/,
                                    fmi3Boolean* /*nominals_changed*/, fmi3Boolean* /*values_changed*/,
                                    fmi3Boolean* /*next_defined*/, fmi3Float64* /*next*/) {
  return refuse3(c, "fmi3UpdateDiscreteStates", kNoEvents);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) {
  return refuse3(c, "fmi3EnterContinuousTimeMode", kNoOtherKind);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean /*never_goes_back*/, fmi3Boolean* /*event_mode*/,
                                       fmi3Boolean* /*terminate*/) {
  return refuse3(c, "fmi3CompletedIntegratorStep", kNoOtherKind);
}

fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 /*time*/) {
  return refuse3(c, "fmi3SetTime", kNoOtherKind);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 /*states*/[], size_t /*count*/) {
  return refuse3(c, "fmi3SetContinuousStates", kNoOtherKind);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 /*derivatives*/[], size_t /*count*/) {
  return refuse3(c, "fmi3GetContinuousStateDerivatives", kNoOtherKind);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 /*indicators*/[], size_t /*count*/) {
  return refuse3(c, "fmi3GetEventIndicators", kNoOtherKind);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 /*states*/[], size_t /*count*/) {
  return refuse3(c, "fmi3GetContinuousStates", kNoOtherKind);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 /*nominals*/[], size_t /*count*/) {
  return refuse3(c, "fmi3GetNominalsOfContinuousStates", kNoOtherKind);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t* /*count*/) {
  return refuse3(c, "fmi3GetNumberOfEventIndicators", kNoOtherKind);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t* /*count*/) {
  return refuse3(c, "fmi3GetNumberOfContinuousStates", kNoOtherKind);
}

fmi3Status fmi3EnterStepMode(fmi3Instance c) {
  return refuse3(c, "fmi3EnterStepMode", kNoEvents);
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference /*refs*/[], size_t /*count*/,
                                    const fmi3Int32 /*orders*/[], fmi3Float64 /*values*/[], size_t /*value_count*/) {
  return refuse3(c, "fmi3GetOutputDerivatives", "outputs have no derivatives (maxOutputDerivativeOrder is 0)");
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference /*clock*/, fmi3Float64 /*time*/) {
  return refuse3(c, "fmi3ActivateModelPartition", kNoOtherKind);
}
