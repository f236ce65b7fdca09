/* SPDX-License-Identifier: Apache-2.0 */
/* Modules in C11, thread or process: what <indurop/indurop.h> is for C++. `glb2idl --c` writes <name>.glb.c.h with the
 * types and variables of <name>.glb; it includes this header. A `::` of a name is a `_` here: knu::Robot::tick is
 * knu_Robot_tick. Programs outside of the schedule use <indurop/c.h>.
 *
 *   #include <indurop/generated.c.h>
 *   int main(void) {
 *     if (irp_initPeriodExe() < 0) return 1;
 *     while (irp_waitPeriod()) {
 *       IRP_SET(knu_Robot_tick, IRP_GET(knu_Robot_tick) + 10);
 *     }
 *   }
 *
 * A thread module (.so) defines `void run(void)`, and if needed `void start(void)`, `void stop(void)` and, if it is
 * sporadic, `int condition(void)`. Shared functions, channels, pools and INDUROP_STATE are for C++ only. */
/* NOLINTBEGIN: the names and types are those of C */
#ifndef INDUROP_MODULE_C_H
#define INDUROP_MODULE_C_H

#ifdef __cplusplus
#error "this header is for C; include <indurop/indurop.h> in C++"
#endif

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- Variables. Each access is atomic and real-time safe; it is the same as that of a C++ module ---- */

/* The value of a variable: IRP_GET(knu_Robot_tick); of a part: IRP_GET(knu_Robot_joints, [3].x). Not for arrays and
 * texts: IRP_READ. */
#define IRP_GET(...) IRP_GET_(__VA_ARGS__, , )

/* Sets a variable: IRP_SET(knu_Robot_tick, 5); a part of one, in one commit: IRP_SET_PART(knu_Robot_joints,
 * [3].x, 1.5). Forced parts keep their values. Not for arrays and texts: IRP_WRITE. */
#define IRP_SET(variable, ...) IRP_SET_PART(variable, , __VA_ARGS__)
#define IRP_SET_PART(variable, part, ...)                                                        \
  __extension__({                                                                                \
    __typeof__(IRP_PART_(variable, part)) irp_new_ = (__VA_ARGS__);                              \
    IRP_ACCESS_(variable, 2);                                                                    \
    indurop_c_set(&irp_ref_##variable, IRP_OFFSET_(variable, part), &irp_new_, sizeof irp_new_); \
  })

/* Copies one consistent version of the whole value to or from an object of the variable's type, whatever it is:
 *   knu_Robot_joints_t all[10];
 *   IRP_READ(knu_Robot_joints, &all);
 * The compiler rejects another type. */
#define IRP_READ(variable, to)                                       \
  __extension__({                                                    \
    __typeof__(IRP_PART_(variable, ))* irp_to_ = (to);               \
    IRP_ACCESS_(variable, 1);                                        \
    indurop_c_get(&irp_ref_##variable, 0, irp_to_, sizeof *irp_to_); \
  })
#define IRP_WRITE(variable, from)                                        \
  __extension__({                                                        \
    const __typeof__(IRP_PART_(variable, ))* irp_from_ = (from);         \
    IRP_ACCESS_(variable, 2);                                            \
    indurop_c_set(&irp_ref_##variable, 0, irp_from_, sizeof *irp_from_); \
  })

/* For a variable of another board: time since that board last confirmed the value, in ns (0: it belongs to this board;
 * INT64_MAX: no value was received yet); and whether the value may be used: the board is not silent, and the value is
 * not older than the maxage of the declaration. */
#define IRP_AGE_NS(variable) (indurop_c_age_ns(&irp_ref_##variable))
#define IRP_VALID(variable) (indurop_c_is_valid(&irp_ref_##variable, irp_max_age_ns_##variable))

/* ---- Life cycle of a process module (Figure 8 of the chapter). Documented in <indurop/irp.h> ---- */

/* Returns 0, or a negative number after a message on stderr. Not real-time safe. */
int irp_initPeriodExe(void);
/* Returns true to run now, false if the node asks the process to end. Real-time safe except for the sleep. */
bool irp_waitPeriod(void);

/* ---- Schedule. Real-time safe ---- */

int64_t irp_period_ns(void);   /* nominal period of the calling module; 0 if it is not periodic */
uint64_t irp_tick(void);       /* basic period that released the present run, from 0 */
int64_t irp_release_ns(void);  /* and its point on the time grid, in ns of CLOCK_MONOTONIC */
int64_t irp_now_ns(void);      /* time of the node in ns; in a simulation its virtual time */
bool irp_stop_requested(void); /* for the loops of non-real-time modules; not real-time safe */

/* ---- Messages and properties ---- */

/* As printf() of C, without %n; in a module it writes to the node's ring of messages: no lock, no allocation, no system
 * call. Returns the length, or -1 if the ring was full (the message is dropped and counted). Real-time safe. */
int irp_printf(const char* format, ...) __attribute__((format(printf, 1, 2)));

/* Returns <property><value name="..."> of the calling module, or `fallback` if there is none or it does not fit the
 * type (then one message is printed). A text is valid until the node's run ends. Not real-time safe: read them in
 * start(), or before the first irp_waitPeriod(). */
int64_t irp_property_integer(const char* name, int64_t fallback);
double irp_property_real(const char* name, double fallback);
bool irp_property_bool(const char* name, bool fallback);
const char* irp_property_text(const char* name, const char* fallback);

/* ---- Details: for generated headers only ---- */

#define INDUROP_C_ABI 5 /* as INDUROP_ABI_VERSION */

typedef struct indurop_c_ref { /* as indurop::abi::Ref */
  uint64_t name_hash;
  uint64_t type_hash;
  void* entry;
  const void* initial;
  uint32_t value_size;
  uint32_t kind;
  const char* name;
} indurop_c_ref;

void indurop_register_refs(indurop_c_ref* refs, uint32_t count, uint32_t abi_version);
void indurop_unregister_refs(indurop_c_ref* refs);
/* They end the run with a fault if the bytes are not all inside of the value. */
void indurop_c_get(const indurop_c_ref* ref, size_t offset, void* to, size_t size);
void indurop_c_set(const indurop_c_ref* ref, size_t offset, const void* from, size_t size);
int64_t indurop_c_age_ns(const indurop_c_ref* ref);
bool indurop_c_is_valid(const indurop_c_ref* ref, int64_t max_age_ns);

#define IRP_PART_(variable, part) (((struct irp_value_##variable*)0)->value part)
#define IRP_OFFSET_(variable, part) (offsetof(struct irp_value_##variable, value part))
#define IRP_GET_(variable, part, ...)                                                            \
  __extension__({                                                                                \
    __typeof__(IRP_PART_(variable, part)) irp_got_;                                              \
    IRP_ACCESS_(variable, 1);                                                                    \
    indurop_c_get(&irp_ref_##variable, IRP_OFFSET_(variable, part), &irp_got_, sizeof irp_got_); \
    irp_got_;                                                                                    \
  })
/* One record for each access, so that the platform knows who reads and writes what before anything runs. */
#define IRP_ACCESS_(variable, direction)                                                              \
  __asm__ volatile(".pushsection .indurop.access,\"\",%%progbits\n\t.long %c0,%c1,%c2\n\t.popsection" \
                   :                                                                                  \
                   : "i"((uint32_t)irp_hash_##variable), "i"((uint32_t)(irp_hash_##variable >> 32)), "i"(direction))

#define INDUROP_C_TEXT_(text) #text
#define INDUROP_C_TEXT(text) INDUROP_C_TEXT_(text)
__asm__(".pushsection .indurop.abi,\"G\",%progbits,indurop_abi_" INDUROP_C_TEXT(INDUROP_C_ABI) ",comdat\n"
        ".long " INDUROP_C_TEXT(INDUROP_C_ABI) "\n"
        ".popsection");

#endif /* INDUROP_MODULE_C_H */
/* NOLINTEND */
