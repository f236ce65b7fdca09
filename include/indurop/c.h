/* SPDX-License-Identifier: Apache-2.0 */
/* The C interface, for programs outside of the schedule: shared variables of a node of this machine, by name. It needs
 * no C++ and nothing else of this folder; link it with -lindurop-c. Modules use <indurop/indurop.h> or, in C,
 * <indurop/module_c.h> instead.
 *
 * Every function that can fail returns an irp_code; irp_error() then returns the reason in words. A null pointer where
 * one is required is IRP_INVALID, never a crash. A handle is for one thread at a time; different handles are
 * independent. Readers map the node's memory read-only and cannot disturb the node. Not real-time safe unless a
 * function says so.
 *
 * Structs that the library fills begin with their size: `irp_variable v = IRP_VARIABLE_INIT;`. A program that was built
 * with an older header works with a newer library. */
/* NOLINTBEGIN: the names and types are those of C */
#ifndef INDUROP_C_H
#define INDUROP_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define IRP_API __attribute__((visibility("default")))

typedef enum irp_code {
  IRP_OK = 0,
  IRP_INVALID = 1,   /* an argument is null or outside of its documented range */
  IRP_NOT_FOUND = 2, /* no such node or variable */
  IRP_DENIED = 3,    /* no permission, or the handle was opened to read */
  IRP_SIZE = 4,      /* the buffer has another size than the value, or is too small for the text */
  IRP_RANGE = 5,     /* not a value of this variable: outside of its type or its declared range */
  IRP_FORCED = 6,    /* the variable is forced: writing it has no effect */
  IRP_LOCKED = 7,    /* the node's write lock forbids it */
  IRP_BUSY = 8,      /* a process that holds a lock is stopped, or values are written without a pause: try again */
  IRP_CHANGED = 9,   /* the node has other variables now: irp_refresh() */
  IRP_TIMEOUT = 10,  /* not within the stated time */
  IRP_GONE = 11,     /* the node has ended; its last values can still be read */
  IRP_VERSION = 12,  /* the node is of a release with another memory layout */
  IRP_CORRUPT = 13,  /* the memory was damaged or truncated by a process with write access */
  IRP_APART = 14,    /* the values do not belong together */
  IRP_SYSTEM = 15    /* anything else: out of memory, an error of the operating system */
} irp_code;

/* Returns what went wrong in the last failed call of this thread and how to correct it, as one line of UTF-8; "" if
 * none failed. Valid until the thread's next failed call. Never null. */
IRP_API const char* irp_error(void);

/* Returns the version of the library, "0.2.0". */
IRP_API const char* irp_version(void);

/* ---- Nodes ---- */

typedef struct irp_node irp_node; /* one node of this machine; its variables have numbers (ids) */

typedef enum irp_access { IRP_READ = 0, IRP_WRITE = 1 } irp_access;

/* Opens a node. `name` null or "": $INDUROP_NODE, else of the running nodes "local" or the only one. IRP_WRITE is for
 * the user of the node, its group, and root. Errors: IRP_NOT_FOUND, IRP_DENIED, IRP_VERSION, IRP_CORRUPT, IRP_INVALID
 * (several nodes run, or the name is none); `*node` is null then. */
IRP_API irp_code irp_open(const char* name, irp_access access, irp_node** node);
IRP_API void irp_close(irp_node* node); /* null: no effect */

/* Valid until the handle is closed; "" for null. */
IRP_API const char* irp_node_name(const irp_node* node);

/* Returns IRP_OK while the node runs, IRP_GONE after it has ended, or IRP_CHANGED. */
IRP_API irp_code irp_running(const irp_node* node);

/* After IRP_CHANGED (a deployment or a new version of a module gave the node other variables, or this one another
 * type): takes the node's present memory. Ids stay valid for variables whose name and type are the same; the others
 * return IRP_NOT_FOUND or IRP_SIZE until they are found again. Without a change it has no effect. Errors: those of
 * irp_open(); the handle then keeps the former memory. */
IRP_API irp_code irp_refresh(irp_node* node);

/* ---- Variables ---- */

/* Number of variables, and their full names in alphabetical order: "knu::Robot::joints". Null outside. */
IRP_API size_t irp_count(const irp_node* node);
IRP_API const char* irp_name(const irp_node* node, size_t index);

/* Finds a variable or a part of one: "knu::Robot::joints[1].y"; leading namespaces may be left out if the rest is
 * unique. Errors: IRP_NOT_FOUND (irp_error() has the nearest name), IRP_CHANGED (it may be one of those that the node
 * has since the handle was opened or refreshed). */
IRP_API irp_code irp_find(irp_node* node, const char* name, uint32_t* id);

enum {
  IRP_HAS_RANGE = 1, /* min and max are declared */
  IRP_RETAIN = 2,    /* kept over restarts */
  IRP_PARAMETER = 4  /* declared with an initial value */
};

/* All texts are valid until the handle is refreshed or closed, and never null. */
typedef struct irp_variable {
  size_t struct_size; /* set by IRP_VARIABLE_INIT */
  const char* name;   /* full name, with the part */
  const char* type;   /* as declared: "knu::Robot::joints_t[10]" */
  /* Layout of the bytes, the same on every machine: "f64", "struct(24,8){x@0:f64,y@8:f64,z@16:f64}[10]". Grammar:
   *   type = base { "[" dim "]" }                                 outermost dimension first
   *   base = "bool" | "char" | "i8" | "u8" | ... | "u64" | "f32" | "f64" | "text(" bytes ")"
   *        | "enum{" name "=" value { "," name "=" value } "}"    4 bytes
   *        | "struct(" size "," align "){" name "@" offset ":" type { "," ... } "}" */
  const char* layout;
  const char* unit;
  const char* description;
  const char* source; /* place of the declaration, "knuRobot.glb:3" */
  size_t size;        /* bytes of the value */
  double min;
  double max;
  uint32_t flags;
} irp_variable;
#define IRP_VARIABLE_INIT \
  { sizeof(irp_variable), NULL, NULL, NULL, NULL, NULL, NULL, 0, 0.0, 0.0, 0 }

/* Errors: IRP_NOT_FOUND (no such id, or the variable is gone). */
IRP_API irp_code irp_describe(const irp_node* node, uint32_t id, irp_variable* variable);

/* ---- Values ---- */

/* Copies one consistent value. `size` is that of irp_describe(). Takes no lock and allocates nothing. Errors: IRP_SIZE,
 * IRP_NOT_FOUND, IRP_CHANGED, IRP_CORRUPT, IRP_BUSY (written without a pause for 50 ms). The last values of a node that
 * has ended are read without an error: irp_running() tells. */
IRP_API irp_code irp_read(const irp_node* node, uint32_t id, void* to, size_t size);

/* Copies several values as they were at one moment, between two writes; values of another board as they were after one
 * update of that board. `to` and `sizes` have `count` elements. Errors: those of irp_read(); IRP_APART: the values are
 * consistent each in itself only, because they change without a pause or come from several boards. */
IRP_API irp_code irp_read_together(const irp_node* node, const uint32_t* ids, size_t count, void* const* to,
                                   const size_t* sizes);

enum {
  IRP_IS_FORCED = 1, /* a part of it is forced */
  IRP_REMOTE = 2,    /* another board owns it */
  IRP_SILENT = 4,    /* that board is silent: the value is the last one, or its fallback */
  IRP_NEVER = 8      /* no value of that board was received yet */
};

typedef struct irp_quality {
  size_t struct_size; /* set by IRP_QUALITY_INIT */
  uint32_t flags;
  int64_t confirmed_ns; /* time since the owning board last confirmed the value; 0 for variables of this board */
} irp_quality;
#define IRP_QUALITY_INIT \
  { sizeof(irp_quality), 0, 0 }

IRP_API irp_code irp_get_quality(const irp_node* node, uint32_t id, irp_quality* quality);

/* Writes the value as text into `to`, with a terminating NUL: "[{x: 1, y: 2}]", enums by name. `*needed`, if not null,
 * is its length with the NUL. Errors: IRP_SIZE (`to` is too small; unchanged), those of irp_read(). */
IRP_API irp_code irp_get_text(const irp_node* node, uint32_t id, char* to, size_t size, size_t* needed);

/* Waits until the value differs from the one `*seen` stands for, and updates `*seen`; 0 stands for none, so that the
 * first call returns at once. It polls each 500 us; changes in between are one. Errors: IRP_TIMEOUT, IRP_GONE (the node
 * ended meanwhile), IRP_CHANGED, those of irp_read(). */
IRP_API irp_code irp_wait_change(const irp_node* node, uint32_t id, uint64_t* seen, int64_t timeout_ns);

/* ---- Every run: gapless values from the node's tape ---- */

typedef struct irp_stream irp_stream;

/* Follows variables: one row for each run of a module that writes one of them; for those that no module writes, of a
 * module that reads them, and for those that no module uses, whenever the node records their changes. `ids` has
 * `count` elements. `past` not 0: begins with the oldest run on the tape (two seconds or more), else with the next one.
 * The stream belongs to the handle: close it first. Errors: IRP_NOT_FOUND (no such id; the node has no tape, or a
 * variable is too large for it), IRP_CHANGED. */
IRP_API irp_code irp_stream_open(const irp_node* node, const uint32_t* ids, size_t count, int past,
                                 irp_stream** stream);
IRP_API void irp_stream_close(irp_stream* stream); /* null: no effect */

/* Copies rows that are ready, at most `max`, into `rows`; if there is none, waits for `timeout_ns`. A row has
 * `row_size` bytes: at byte 0 the tick of the run (uint64_t), at byte 8 the time of its end (int64_t, ns of the node's
 * clock), and at `offsets[i]` the value of variable i after the run. `*taken` is their number. Rows come in the order
 * of their times. Errors: IRP_TIMEOUT, IRP_GONE and IRP_CHANGED (all rows were taken before), IRP_SIZE (an offset and
 * its value exceed the row). */
IRP_API irp_code irp_stream_read(irp_stream* stream, void* rows, size_t row_size, const size_t* offsets, size_t max,
                                 int64_t timeout_ns, size_t* taken);

/* Returns the number of runs that were overwritten before they were read; 0: the rows have no gap. */
IRP_API uint64_t irp_stream_lost(const irp_stream* stream);

/* ---- Recordings: values over time, of an MCAP file that `indurop record` or `indurop run --record` wrote ---- */

typedef struct irp_recording irp_recording; /* a file, its variables with their ids, and a place in it */

/* Opens a file with its present content. What is damaged in it is left out: irp_recording_damage(). Errors:
 * IRP_NOT_FOUND, IRP_DENIED, IRP_CORRUPT (it is no recording); `*recording` is null then. */
IRP_API irp_code irp_recording_open(const char* path, irp_recording** recording);
IRP_API void irp_recording_close(irp_recording* recording); /* null: no effect */

/* Number of variables, and their full names in alphabetical order, of a file of several boards with the board in front:
 * "sensor/cell::encoder". Null outside. */
IRP_API size_t irp_recording_count(const irp_recording* recording);
IRP_API const char* irp_recording_name(const irp_recording* recording, size_t index);

/* As irp_find() and irp_describe(). A recording has units and descriptions of whole variables, and no ranges. Texts are
 * valid until it is closed. */
IRP_API irp_code irp_recording_find(irp_recording* recording, const char* name, uint32_t* id);
IRP_API irp_code irp_recording_describe(const irp_recording* recording, uint32_t id, irp_variable* variable);

/* Times of the first and the last sample of the file: ns since 1970, of a simulation its virtual time. Both are 0 if
 * there is none. */
IRP_API irp_code irp_recording_span(const irp_recording* recording, int64_t* begin_ns, int64_t* end_ns);

/* Chooses what irp_recording_read() returns from now on: samples of these variables from `from_ns` to `to_ns`, both
 * included. A sample is recorded when a run begins with a new value and when it ends with one, so each module that uses
 * a variable adds some. `repeats` 0: those with the value that the variable had before are left out. */
IRP_API irp_code irp_recording_select(irp_recording* recording, const uint32_t* ids, size_t count, int64_t from_ns,
                                      int64_t to_ns, int repeats);

/* Copies the next samples, at most `max`, in the order of their times: the time of sample i to `times[i]`, the place of
 * its variable in the `ids` of irp_recording_select() to `which[i]`, its value to byte `i * stride` of `values`.
 * `*taken` is their number; less than `max`: there are no more. Errors: IRP_SIZE (a value is longer than `stride`). */
IRP_API irp_code irp_recording_read(irp_recording* recording, int64_t* times, uint32_t* which, void* values,
                                    size_t stride, size_t max, size_t* taken);

/* Returns what is missing or damaged in the file as far as it was read, one text for each part; null after the last.
 * Valid until the recording is closed. */
IRP_API const char* irp_recording_damage(const irp_recording* recording, size_t index);

/* ---- Changes. Each is noted in the node's journal with user and reason (`reason` may be null) ---- */

/* Sets a value once, exactly these bytes (of a NaN, some NaN). Errors: IRP_DENIED, IRP_LOCKED, IRP_FORCED, IRP_RANGE,
 * IRP_BUSY, those of irp_read(). Nothing is written then. */
IRP_API irp_code irp_write(irp_node* node, uint32_t id, const void* from, size_t size, const char* reason);
/* The same with the value as text: "1.5", "{x: 1}" (fields that are left out keep their values), "HOMING". */
IRP_API irp_code irp_set_text(irp_node* node, uint32_t id, const char* text, const char* reason);

/* Holds the value against all writers for `for_ns`, 0: until it is released. Errors: as irp_write(). */
IRP_API irp_code irp_force(irp_node* node, uint32_t id, const void* from, size_t size, int64_t for_ns,
                           const char* reason);
/* Errors: IRP_NOT_FOUND (it is not forced), IRP_DENIED, IRP_LOCKED, IRP_BUSY. */
IRP_API irp_code irp_release(irp_node* node, uint32_t id, const char* reason);

#ifdef __cplusplus
}
#endif

#endif /* INDUROP_C_H */
/* NOLINTEND */
