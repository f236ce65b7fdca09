/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/integration/fmi/master.h"

#include <dlfcn.h>
#include <string.h>

/* All functions that the standards define. */
static const char* const kNames2[] = {"fmi2GetTypesPlatform",
                                      "fmi2GetVersion",
                                      "fmi2SetDebugLogging",
                                      "fmi2Instantiate",
                                      "fmi2FreeInstance",
                                      "fmi2SetupExperiment",
                                      "fmi2EnterInitializationMode",
                                      "fmi2ExitInitializationMode",
                                      "fmi2Terminate",
                                      "fmi2Reset",
                                      "fmi2GetReal",
                                      "fmi2GetInteger",
                                      "fmi2GetBoolean",
                                      "fmi2GetString",
                                      "fmi2SetReal",
                                      "fmi2SetInteger",
                                      "fmi2SetBoolean",
                                      "fmi2SetString",
                                      "fmi2GetFMUstate",
                                      "fmi2SetFMUstate",
                                      "fmi2FreeFMUstate",
                                      "fmi2SerializedFMUstateSize",
                                      "fmi2SerializeFMUstate",
                                      "fmi2DeSerializeFMUstate",
                                      "fmi2GetDirectionalDerivative",
                                      "fmi2SetRealInputDerivatives",
                                      "fmi2GetRealOutputDerivatives",
                                      "fmi2DoStep",
                                      "fmi2CancelStep",
                                      "fmi2GetStatus",
                                      "fmi2GetRealStatus",
                                      "fmi2GetIntegerStatus",
                                      "fmi2GetBooleanStatus",
                                      "fmi2GetStringStatus",
                                      "fmi2EnterEventMode",
                                      "fmi2NewDiscreteStates",
                                      "fmi2EnterContinuousTimeMode",
                                      "fmi2CompletedIntegratorStep",
                                      "fmi2SetTime",
                                      "fmi2SetContinuousStates",
                                      "fmi2GetDerivatives",
                                      "fmi2GetEventIndicators",
                                      "fmi2GetContinuousStates",
                                      "fmi2GetNominalsOfContinuousStates"};

static const char* const kNames3[] = {"fmi3GetVersion",
                                      "fmi3SetDebugLogging",
                                      "fmi3InstantiateModelExchange",
                                      "fmi3InstantiateCoSimulation",
                                      "fmi3InstantiateScheduledExecution",
                                      "fmi3FreeInstance",
                                      "fmi3EnterInitializationMode",
                                      "fmi3ExitInitializationMode",
                                      "fmi3EnterEventMode",
                                      "fmi3Terminate",
                                      "fmi3Reset",
                                      "fmi3GetFloat32",
                                      "fmi3GetFloat64",
                                      "fmi3GetInt8",
                                      "fmi3GetUInt8",
                                      "fmi3GetInt16",
                                      "fmi3GetUInt16",
                                      "fmi3GetInt32",
                                      "fmi3GetUInt32",
                                      "fmi3GetInt64",
                                      "fmi3GetUInt64",
                                      "fmi3GetBoolean",
                                      "fmi3GetString",
                                      "fmi3GetBinary",
                                      "fmi3GetClock",
                                      "fmi3SetFloat32",
                                      "fmi3SetFloat64",
                                      "fmi3SetInt8",
                                      "fmi3SetUInt8",
                                      "fmi3SetInt16",
                                      "fmi3SetUInt16",
                                      "fmi3SetInt32",
                                      "fmi3SetUInt32",
                                      "fmi3SetInt64",
                                      "fmi3SetUInt64",
                                      "fmi3SetBoolean",
                                      "fmi3SetString",
                                      "fmi3SetBinary",
                                      "fmi3SetClock",
                                      "fmi3GetNumberOfVariableDependencies",
                                      "fmi3GetVariableDependencies",
                                      "fmi3GetFMUState",
                                      "fmi3SetFMUState",
                                      "fmi3FreeFMUState",
                                      "fmi3SerializedFMUStateSize",
                                      "fmi3SerializeFMUState",
                                      "fmi3DeserializeFMUState",
                                      "fmi3GetDirectionalDerivative",
                                      "fmi3GetAdjointDerivative",
                                      "fmi3EnterConfigurationMode",
                                      "fmi3ExitConfigurationMode",
                                      "fmi3GetIntervalDecimal",
                                      "fmi3GetIntervalFraction",
                                      "fmi3GetShiftDecimal",
                                      "fmi3GetShiftFraction",
                                      "fmi3SetIntervalDecimal",
                                      "fmi3SetIntervalFraction",
                                      "fmi3SetShiftDecimal",
                                      "fmi3SetShiftFraction",
                                      "fmi3EvaluateDiscreteStates",
                                      "fmi3UpdateDiscreteStates",
                                      "fmi3EnterContinuousTimeMode",
                                      "fmi3CompletedIntegratorStep",
                                      "fmi3SetTime",
                                      "fmi3SetContinuousStates",
                                      "fmi3GetContinuousStateDerivatives",
                                      "fmi3GetEventIndicators",
                                      "fmi3GetContinuousStates",
                                      "fmi3GetNominalsOfContinuousStates",
                                      "fmi3GetNumberOfEventIndicators",
                                      "fmi3GetNumberOfContinuousStates",
                                      "fmi3EnterStepMode",
                                      "fmi3GetOutputDerivatives",
                                      "fmi3DoStep",
                                      "fmi3ActivateModelPartition"};

static const char* open_library(void** library, const char* file, const char* const* names, size_t count) {
  *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (*library == NULL) {
    return dlerror();
  }
  for (size_t i = 0; i < count; ++i) {
    if (dlsym(*library, names[i]) == NULL) {
      return names[i];
    }
  }
  return NULL;
}

static void find(void* library, const char* name, void* to) {
  void* const function = dlsym(library, name);
  memcpy(to, &function, sizeof function);
}

const char* open_master2(struct Master2* master, const char* library) {
  const char* const missing = open_library(&master->library, library, kNames2, sizeof kNames2 / sizeof kNames2[0]);
  if (missing != NULL) {
    return missing;
  }
  find(master->library, "fmi2Instantiate", &master->instantiate);
  find(master->library, "fmi2FreeInstance", &master->free_instance);
  find(master->library, "fmi2SetDebugLogging", &master->set_logging);
  find(master->library, "fmi2SetupExperiment", &master->set_up);
  find(master->library, "fmi2EnterInitializationMode", &master->enter_initialization);
  find(master->library, "fmi2ExitInitializationMode", &master->exit_initialization);
  find(master->library, "fmi2DoStep", &master->step);
  find(master->library, "fmi2Terminate", &master->terminate);
  find(master->library, "fmi2Reset", &master->reset);
  find(master->library, "fmi2GetReal", &master->get_real);
  find(master->library, "fmi2SetReal", &master->set_real);
  find(master->library, "fmi2GetInteger", &master->get_integer);
  find(master->library, "fmi2SetInteger", &master->set_integer);
  find(master->library, "fmi2GetBoolean", &master->get_boolean);
  find(master->library, "fmi2SetBoolean", &master->set_boolean);
  find(master->library, "fmi2GetString", &master->get_string);
  find(master->library, "fmi2SetString", &master->set_string);
  find(master->library, "fmi2GetFMUstate", &master->get_state);
  find(master->library, "fmi2GetRealStatus", &master->get_real_status);
  find(master->library, "fmi2GetStatus", &master->get_status);
  find(master->library, "fmi2GetBooleanStatus", &master->get_boolean_status);
  find(master->library, "fmi2CancelStep", &master->cancel_step);
  find(master->library, "fmi2SetTime", &master->set_time);
  return NULL;
}

const char* open_master3(struct Master3* master, const char* library) {
  const char* const missing = open_library(&master->library, library, kNames3, sizeof kNames3 / sizeof kNames3[0]);
  if (missing != NULL) {
    return missing;
  }
  find(master->library, "fmi3InstantiateCoSimulation", &master->instantiate);
  find(master->library, "fmi3InstantiateModelExchange", &master->instantiate_exchange);
  find(master->library, "fmi3FreeInstance", &master->free_instance);
  find(master->library, "fmi3EnterInitializationMode", &master->enter_initialization);
  find(master->library, "fmi3ExitInitializationMode", &master->exit_initialization);
  find(master->library, "fmi3DoStep", &master->step);
  find(master->library, "fmi3Terminate", &master->terminate);
  find(master->library, "fmi3Reset", &master->reset);
  find(master->library, "fmi3GetFloat32", &master->get_float32);
  find(master->library, "fmi3SetFloat32", &master->set_float32);
  find(master->library, "fmi3GetFloat64", &master->get_float64);
  find(master->library, "fmi3SetFloat64", &master->set_float64);
  find(master->library, "fmi3GetInt8", &master->get_int8);
  find(master->library, "fmi3SetInt8", &master->set_int8);
  find(master->library, "fmi3GetUInt8", &master->get_uint8);
  find(master->library, "fmi3SetUInt8", &master->set_uint8);
  find(master->library, "fmi3GetInt16", &master->get_int16);
  find(master->library, "fmi3SetInt16", &master->set_int16);
  find(master->library, "fmi3GetUInt16", &master->get_uint16);
  find(master->library, "fmi3SetUInt16", &master->set_uint16);
  find(master->library, "fmi3GetInt32", &master->get_int32);
  find(master->library, "fmi3SetInt32", &master->set_int32);
  find(master->library, "fmi3GetUInt32", &master->get_uint32);
  find(master->library, "fmi3SetUInt32", &master->set_uint32);
  find(master->library, "fmi3GetInt64", &master->get_int64);
  find(master->library, "fmi3SetInt64", &master->set_int64);
  find(master->library, "fmi3GetUInt64", &master->get_uint64);
  find(master->library, "fmi3SetUInt64", &master->set_uint64);
  find(master->library, "fmi3GetBoolean", &master->get_boolean);
  find(master->library, "fmi3SetBoolean", &master->set_boolean);
  find(master->library, "fmi3GetString", &master->get_string);
  find(master->library, "fmi3SetString", &master->set_string);
  find(master->library, "fmi3GetClock", &master->get_clock);
  return NULL;
}
