/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of an FMU's library, found as any master finds them: by name, with dlopen(). */

#pragma once

#include "control/io/fmu/fmi2.h"
#include "control/io/fmu/fmi3.h"

#ifdef __cplusplus
extern "C" {
#endif

struct Master2 {
  void* library;
  __typeof__(&fmi2Instantiate) instantiate;
  __typeof__(&fmi2FreeInstance) free_instance;
  __typeof__(&fmi2SetDebugLogging) set_logging;
  __typeof__(&fmi2SetupExperiment) set_up;
  __typeof__(&fmi2EnterInitializationMode) enter_initialization;
  __typeof__(&fmi2ExitInitializationMode) exit_initialization;
  __typeof__(&fmi2DoStep) step;
  __typeof__(&fmi2Terminate) terminate;
  __typeof__(&fmi2Reset) reset;
  __typeof__(&fmi2GetReal) get_real;
  __typeof__(&fmi2SetReal) set_real;
  __typeof__(&fmi2GetInteger) get_integer;
  __typeof__(&fmi2SetInteger) set_integer;
  __typeof__(&fmi2GetBoolean) get_boolean;
  __typeof__(&fmi2SetBoolean) set_boolean;
  __typeof__(&fmi2GetString) get_string;
  __typeof__(&fmi2SetString) set_string;
  __typeof__(&fmi2GetFMUstate) get_state;
  __typeof__(&fmi2GetRealStatus) get_real_status;
  __typeof__(&fmi2GetStatus) get_status;
  __typeof__(&fmi2GetBooleanStatus) get_boolean_status;
  __typeof__(&fmi2CancelStep) cancel_step;
  __typeof__(&fmi2SetTime) set_time;
};

struct Master3 {
  void* library;
  __typeof__(&fmi3InstantiateCoSimulation) instantiate;
  __typeof__(&fmi3InstantiateModelExchange) instantiate_exchange;
  __typeof__(&fmi3FreeInstance) free_instance;
  __typeof__(&fmi3EnterInitializationMode) enter_initialization;
  __typeof__(&fmi3ExitInitializationMode) exit_initialization;
  __typeof__(&fmi3DoStep) step;
  __typeof__(&fmi3Terminate) terminate;
  __typeof__(&fmi3Reset) reset;
  __typeof__(&fmi3GetFloat32) get_float32;
  __typeof__(&fmi3SetFloat32) set_float32;
  __typeof__(&fmi3GetFloat64) get_float64;
  __typeof__(&fmi3SetFloat64) set_float64;
  __typeof__(&fmi3GetInt8) get_int8;
  __typeof__(&fmi3SetInt8) set_int8;
  __typeof__(&fmi3GetUInt8) get_uint8;
  __typeof__(&fmi3SetUInt8) set_uint8;
  __typeof__(&fmi3GetInt16) get_int16;
  __typeof__(&fmi3SetInt16) set_int16;
  __typeof__(&fmi3GetUInt16) get_uint16;
  __typeof__(&fmi3SetUInt16) set_uint16;
  __typeof__(&fmi3GetInt32) get_int32;
  __typeof__(&fmi3SetInt32) set_int32;
  __typeof__(&fmi3GetUInt32) get_uint32;
  __typeof__(&fmi3SetUInt32) set_uint32;
  __typeof__(&fmi3GetInt64) get_int64;
  __typeof__(&fmi3SetInt64) set_int64;
  __typeof__(&fmi3GetUInt64) get_uint64;
  __typeof__(&fmi3SetUInt64) set_uint64;
  __typeof__(&fmi3GetBoolean) get_boolean;
  __typeof__(&fmi3SetBoolean) set_boolean;
  __typeof__(&fmi3GetString) get_string;
  __typeof__(&fmi3SetString) set_string;
  __typeof__(&fmi3GetClock) get_clock;
};

/* Return the first function of the standard that the library lacks, or why it cannot be loaded; null: all are there. */
const char* open_master2(struct Master2* master, const char* library);
const char* open_master3(struct Master3* master, const char* library);

#ifdef __cplusplus
}
#endif
