/* SPDX-License-Identifier: Apache-2.0 */
/* A first-order lag as an FMU, as another tool would make it: written by hand from the text of the standard, without
   headers and code of this project. x' = (gain u - x) / T is solved exactly for an input that is constant in a step.
   FMI is 2 or 3. The parameter "fault" makes it misbehave in the step number "at". */

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT __attribute__((visibility("default")))
#define TOKEN "{1f2b8e60-lag}"

enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING };
enum { NONE, FAIL, REFUSE, CRASH, DIE, END, NAN_OUT, CHATTER, HANG_ON, EARLY, CRASH_AT_START, FAIL_AT_START };

typedef unsigned int Reference;
#if FMI == 2
typedef void (*Logger)(void* environment, const char* instance, int status, const char* category, const char* text, ...);
#else
typedef void (*Logger)(void* environment, int status, const char* category, const char* text);
#endif

typedef struct {
  Logger log;
  void* environment;
  char* name;
  double time, u, x, T, gain;
  double vector[6];
  int steps, fault, at, choice, first_byte, mode;  /* mode: 0 instantiated, 1 initialization, 2 stepping */
  bool flag, has_ended;
  char text[64];
  char echo[129];
  char folder[4096];
  int64_t whole[8];  /* by size and sign */
  float small;
} Lag;

/* References of the model description. */
enum { TIME, U, Y, TAU, GAIN, STEPS, FAULT, AT, FLAG, FLAG_OUT, CHOICE, CHOICE_OUT, TEXT, LENGTH, BYTE, VECTOR, TWICE,
       SMALL = 20, SMALL_OUT, WHOLE = 30, WHOLE_OUT = 40, COUNTER = 50, WORD, ECHO };

static void say(Lag* lag, int status, const char* category, const char* text) {
  if (lag->log != NULL) {
#if FMI == 2
    lag->log(lag->environment, lag->name, status, category, "%s", text);
#else
    lag->log(lag->environment, status, category, text);
#endif
  }
}

static int* volatile nowhere;

/* Of the library, not of the instance: two instances that share it count together. */
static int counter;

static Lag* create(const char* name, const char* token, const char* folder, Logger log, void* environment) {
  Lag* lag = calloc(1, sizeof *lag);
  lag->log = log;
  lag->environment = environment;
  lag->name = strdup(name);
  lag->T = 0.1;
  lag->gain = 1;
  ++counter;
  snprintf(lag->folder, sizeof lag->folder, "%s", folder);
  if (strcmp(token, TOKEN) != 0) {
    say(lag, ERROR, "logStatusError", "the token is not that of this library");
    free(lag->name);
    free(lag);
    return NULL;
  }
  return lag;
}

static int start(Lag* lag) {
  char path[5000];
  snprintf(path, sizeof path, "%s/data.txt", lag->folder);
  FILE* file = fopen(path, "r");
  lag->first_byte = file == NULL ? -1 : fgetc(file);
  if (file != NULL) {
    fclose(file);
  }
  if (lag->fault == CRASH_AT_START) {
    *nowhere = 1;
  }
  if (lag->fault == FAIL_AT_START) {
    say(lag, ERROR, "logStatusError", "no equilibrium was found");
    return ERROR;
  }
  lag->mode = 1;
  return OK;
}

static int step(Lag* lag, double at, double size) {
  if (lag->mode != 2 || fabs(at - lag->time) > 1e-9 || size <= 0) {
    say(lag, ERROR, "logStatusError", "doStep is not called at the time that was reached");
    return ERROR;
  }
  ++lag->steps;
  if (lag->steps == lag->at) {
    switch (lag->fault) {
      case FAIL:
        say(lag, ERROR, "logStatusError", "the solver does not converge");
        return ERROR;
      case REFUSE:
        return DISCARD;
      case CRASH:
        *nowhere = 1;
        break;
      case DIE:
        say(lag, FATAL, "logStatusFatal", "out of licences");
        return FATAL;
      case END:
        lag->has_ended = true;
        break;
      case CHATTER:
        say(lag, WARNING, "logStatusWarning", "near a singularity\033[2J\n");
        say(lag, OK, "events", "100%s of it");
        break;
      case HANG_ON:
        for (;;) {
        }
      default:
        break;
    }
  }
  const double target = lag->gain * lag->u;
  lag->x = target + (lag->x - target) * exp(-size / lag->T);
  lag->time = at + size;
  return OK;
}

static double real_of(const Lag* lag, Reference reference, bool* known) {
  switch (reference) {
    case TIME:
      return lag->time;
    case U:
      return lag->u;
    case Y:
      return lag->fault == NAN_OUT && lag->steps >= lag->at ? NAN : lag->x;
    case TAU:
      return lag->T;
    case GAIN:
      return lag->gain;
    default:
      *known = false;
      return 0;
  }
}

static int whole_of(const Lag* lag, Reference reference, bool* known) {
  switch (reference) {
    case STEPS:
      return lag->steps;
    case FAULT:
      return lag->fault;
    case AT:
      return lag->at;
    case CHOICE:
    case CHOICE_OUT:
      return lag->choice;
    case LENGTH:
      return (int)strlen(lag->text);
    case BYTE:
      return lag->first_byte;
    case COUNTER:
      return counter;
    default:
      *known = false;
      return 0;
  }
}

static bool set_real(Lag* lag, Reference reference, double value) {
  double* const to = reference == U ? &lag->u : reference == TAU ? &lag->T : reference == GAIN ? &lag->gain : NULL;
  if (to == NULL || (reference == TAU && lag->mode != 0)) {
    return false;
  }
  *to = value;
  return true;
}

static bool set_whole(Lag* lag, Reference reference, int value) {
  int* const to = reference == FAULT ? &lag->fault
                  : reference == AT  ? &lag->at
                  : reference == CHOICE ? &lag->choice : NULL;
  if (to == NULL) {
    return false;
  }
  *to = value;
  return true;
}

static const char* text_of(Lag* lag, Reference reference) {
  snprintf(lag->echo, sizeof lag->echo, reference == ECHO ? "%s%s" : "%s", lag->text, lag->text);
  return lag->echo;
}

static int judge(Lag* lag, bool known) {
  if (!known) {
    say(lag, ERROR, "logStatusError", "no such variable, or not now");
  }
  return known ? OK : ERROR;
}

#if FMI == 2

typedef struct {
  Logger logger;
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*step_finished)(void*, int);
  void* environment;
} Callbacks;

EXPORT const char* fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char* fmi2GetVersion(void) { return "2.0"; }
EXPORT int fmi2SetDebugLogging(void* c, int on, size_t count, const char* const categories[]) {
  (void)c, (void)on, (void)count, (void)categories;
  return OK;
}
EXPORT void* fmi2Instantiate(const char* name, int type, const char* guid, const char* resources,
                             const Callbacks* callbacks, int visible, int logging) {
  (void)visible, (void)logging;
  char folder[4096] = "";
  size_t n = 0;
  const char* from = strncmp(resources, "file://", 7) == 0 ? resources + 7 : resources;
  for (; *from != 0 && n + 1 < sizeof folder; ++from) {  /* %20 */
    unsigned int code = 0;
    if (*from == '%' && sscanf(from + 1, "%2x", &code) == 1) {
      from += 2;
    }
    folder[n++] = code != 0 ? (char)code : *from;
  }
  return type == 1 ? create(name, guid, folder, callbacks->logger, callbacks->environment) : NULL;
}
EXPORT void fmi2FreeInstance(void* c) {
  Lag* lag = c;
  free(lag->name);
  free(lag);
}
EXPORT int fmi2SetupExperiment(void* c, int has_tolerance, double tolerance, double begin, int has_stop, double stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((Lag*)c)->time = begin;
  return OK;
}
EXPORT int fmi2EnterInitializationMode(void* c) { return start(c); }
EXPORT int fmi2ExitInitializationMode(void* c) {
  ((Lag*)c)->mode = 2;
  return OK;
}
EXPORT int fmi2Terminate(void* c) { return (void)c, OK; }
EXPORT int fmi2Reset(void* c) { return (void)c, ERROR; }
EXPORT int fmi2DoStep(void* c, double at, double size, int never_back) {
  (void)never_back;
  const int status = step(c, at, size);
  return ((Lag*)c)->has_ended ? DISCARD : status;
}
EXPORT int fmi2GetBooleanStatus(void* c, int kind, int* value) {
  *value = kind == 3 && ((Lag*)c)->has_ended;
  return OK;
}
EXPORT int fmi2GetReal(void* c, const Reference refs[], size_t count, double values[]) {
  bool known = true;
  for (size_t i = 0; i < count; ++i) {
    values[i] = real_of(c, refs[i], &known);
  }
  return judge(c, known);
}
EXPORT int fmi2GetInteger(void* c, const Reference refs[], size_t count, int values[]) {
  bool known = true;
  for (size_t i = 0; i < count; ++i) {
    values[i] = whole_of(c, refs[i], &known);
  }
  return judge(c, known);
}
EXPORT int fmi2GetBoolean(void* c, const Reference refs[], size_t count, int values[]) {
  for (size_t i = 0; i < count; ++i) {
    values[i] = refs[i] == FLAG_OUT ? !((Lag*)c)->flag : ((Lag*)c)->flag;
  }
  return OK;
}
EXPORT int fmi2SetReal(void* c, const Reference refs[], size_t count, const double values[]) {
  bool known = true;
  for (size_t i = 0; i < count; ++i) {
    known = set_real(c, refs[i], values[i]) && known;
  }
  return judge(c, known);
}
EXPORT int fmi2SetInteger(void* c, const Reference refs[], size_t count, const int values[]) {
  bool known = true;
  for (size_t i = 0; i < count; ++i) {
    known = set_whole(c, refs[i], values[i]) && known;
  }
  return judge(c, known);
}
EXPORT int fmi2SetBoolean(void* c, const Reference refs[], size_t count, const int values[]) {
  for (size_t i = 0; i < count; ++i) {
    ((Lag*)c)->flag = refs[i] == FLAG && values[i] != 0;
  }
  return OK;
}
/* Of the parameter "text", and of the output "echo", which has it twice. */
EXPORT int fmi2GetString(void* c, const Reference refs[], size_t count, const char* values[]) {
  for (size_t i = 0; i < count; ++i) {
    values[i] = text_of(c, refs[i]);
  }
  return OK;
}
EXPORT int fmi2SetString(void* c, const Reference refs[], size_t count, const char* const values[]) {
  for (size_t i = 0; i < count && (refs[i] == TEXT || refs[i] == WORD); ++i) {
    snprintf(((Lag*)c)->text, sizeof ((Lag*)c)->text, "%s", values[i]);
  }
  return OK;
}

#else

EXPORT const char* fmi3GetVersion(void) { return "3.0"; }
EXPORT int fmi3SetDebugLogging(void* c, bool on, size_t count, const char* const categories[]) {
  (void)c, (void)on, (void)count, (void)categories;
  return OK;
}
EXPORT void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible,
                                         bool logging, bool event_mode, bool early_return, const Reference required[],
                                         size_t required_count, void* environment, Logger log, void* update) {
  (void)visible, (void)logging, (void)required, (void)update;
  return event_mode || early_return || required_count > 0 ? NULL : create(name, token, resources, log, environment);
}
EXPORT void fmi3FreeInstance(void* c) {
  Lag* lag = c;
  free(lag->name);
  free(lag);
}
EXPORT int fmi3EnterInitializationMode(void* c, bool has_tolerance, double tolerance, double begin, bool has_stop,
                                       double stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((Lag*)c)->time = begin;
  return start(c);
}
EXPORT int fmi3ExitInitializationMode(void* c) {
  ((Lag*)c)->mode = 2;
  return OK;
}
EXPORT int fmi3Terminate(void* c) { return (void)c, OK; }
EXPORT int fmi3DoStep(void* c, double at, double size, bool never_back, bool* event, bool* terminate, bool* early,
                      double* last) {
  (void)never_back;
  Lag* lag = c;
  const int status = step(lag, at, size);
  *event = false;
  *terminate = lag->has_ended;
  *early = lag->fault == EARLY && lag->steps == lag->at;
  *last = *early ? at : at + size;
  return status;
}

static int get_float64(Lag* lag, Reference ref, double values[], size_t count) {
  bool known = true;
  if (ref == VECTOR || ref == TWICE) {
    for (size_t i = 0; i < count && count == 6; ++i) {
      values[i] = lag->vector[i] * (ref == TWICE ? 2 : 1);
    }
    return judge(lag, count == 6);
  }
  values[0] = real_of(lag, ref, &known);
  return judge(lag, known && count == 1);
}
EXPORT int fmi3GetFloat64(void* c, const Reference refs[], size_t count, double values[], size_t value_count) {
  return count == 1 ? get_float64(c, refs[0], values, value_count) : ERROR;
}
EXPORT int fmi3SetFloat64(void* c, const Reference refs[], size_t count, const double values[], size_t value_count) {
  Lag* lag = c;
  if (count == 1 && refs[0] == VECTOR) {
    memcpy(lag->vector, values, value_count == 6 ? sizeof lag->vector : 0);
    return judge(lag, value_count == 6);
  }
  return judge(lag, count == 1 && value_count == 1 && set_real(lag, refs[0], values[0]));
}
EXPORT int fmi3GetFloat32(void* c, const Reference refs[], size_t count, float values[], size_t value_count) {
  values[0] = ((Lag*)c)->small;
  return judge(c, count == 1 && value_count == 1 && (refs[0] == SMALL || refs[0] == SMALL_OUT));
}
EXPORT int fmi3SetFloat32(void* c, const Reference refs[], size_t count, const float values[], size_t value_count) {
  ((Lag*)c)->small = values[0];
  return judge(c, count == 1 && value_count == 1 && refs[0] == SMALL);
}

/* Outputs are copies of the inputs. Int32 has other variables, too. */
#define WHOLE_TYPE(NAME, TYPE, INDEX)                                                                                 \
  EXPORT int fmi3Get##NAME(void* c, const Reference refs[], size_t count, TYPE values[], size_t value_count) {         \
    bool known = count == 1 && value_count == 1;                                                                       \
    values[0] = refs[0] >= WHOLE && refs[0] < COUNTER ? (TYPE)((Lag*)c)->whole[INDEX]                                  \
                                                      : (TYPE)whole_of(c, refs[0], &known);                            \
    return judge(c, known);                                                                                            \
  }                                                                                                                    \
  EXPORT int fmi3Set##NAME(void* c, const Reference refs[], size_t count, const TYPE values[], size_t value_count) {   \
    if (count == 1 && refs[0] == WHOLE + (INDEX)) {                                                                    \
      ((Lag*)c)->whole[INDEX] = (int64_t)values[0];                                                                    \
      return OK;                                                                                                       \
    }                                                                                                                  \
    return judge(c, count == 1 && value_count == 1 && set_whole(c, refs[0], (int)values[0]));                          \
  }
WHOLE_TYPE(Int8, int8_t, 0)
WHOLE_TYPE(UInt8, uint8_t, 1)
WHOLE_TYPE(Int16, int16_t, 2)
WHOLE_TYPE(UInt16, uint16_t, 3)
WHOLE_TYPE(Int32, int32_t, 4)
WHOLE_TYPE(UInt32, uint32_t, 5)
WHOLE_TYPE(Int64, int64_t, 6)
WHOLE_TYPE(UInt64, uint64_t, 7)

EXPORT int fmi3GetBoolean(void* c, const Reference refs[], size_t count, bool values[], size_t value_count) {
  values[0] = refs[0] == FLAG_OUT ? !((Lag*)c)->flag : ((Lag*)c)->flag;
  return judge(c, count == 1 && value_count == 1);
}
EXPORT int fmi3SetBoolean(void* c, const Reference refs[], size_t count, const bool values[], size_t value_count) {
  ((Lag*)c)->flag = values[0];
  return judge(c, count == 1 && value_count == 1 && refs[0] == FLAG);
}
EXPORT int fmi3GetString(void* c, const Reference refs[], size_t count, const char* values[], size_t value_count) {
  values[0] = text_of(c, refs[0]);
  return judge(c, count == 1 && value_count == 1);
}
EXPORT int fmi3SetString(void* c, const Reference refs[], size_t count, const char* const values[], size_t value_count) {
  snprintf(((Lag*)c)->text, sizeof ((Lag*)c)->text, "%s", values[0]);
  return judge(c, count == 1 && value_count == 1 && (refs[0] == TEXT || refs[0] == WORD));
}

#endif
