/* SPDX-License-Identifier: Apache-2.0 */
/* A module in C as the test in C++ sees it: each of its accesses as a function. */
#include <indurop/generated.c.h>

#define FOR_EACH(use)                                                                                           \
  use(flag) use(letter) use(i8) use(u8) use(i16) use(u16) use(i32) use(u32) use(i64) use(u64) use(f32) use(f64) \
      use(mode) use(part) use(parts) use(vector) use(label) use(labels)

#define DEFINE(name)                      \
  void c_read_##name(void* to);           \
  void c_read_##name(void* to) {          \
    IRP_READ(both_sides_##name, to);      \
  }                                       \
  void c_write_##name(const void* from);  \
  void c_write_##name(const void* from) { \
    IRP_WRITE(both_sides_##name, from);   \
  }
FOR_EACH(DEFINE)

double c_get_x(int i);
double c_get_x(int i) {
  return IRP_GET(both_sides_parts, [i].x);
}
void c_set_cell(int i, int row, int column, uint16_t value);
void c_set_cell(int i, int row, int column, uint16_t value) {
  IRP_SET_PART(both_sides_parts, [i].grid[row][column], value);
}
void c_double_all(void);
void c_double_all(void) {
  IRP_SET(both_sides_u32, IRP_GET(both_sides_u32) * 2);
  IRP_SET(both_sides_f64, IRP_GET(both_sides_f64) * 2);
  both_sides_Part part = IRP_GET(both_sides_part);
  part.x *= 2;
  part.mode = both_sides_Off;
  IRP_SET(both_sides_part, part);
}
int64_t c_age_ns(void);
int64_t c_age_ns(void) {
  return IRP_AGE_NS(both_sides_f64);
}
bool c_is_valid(void);
bool c_is_valid(void) {
  return IRP_VALID(both_sides_f64);
}
int c_print(const char* text);
int c_print(const char* text) {
  return irp_printf("%d %5.2f|%-6s|%#x %llu %c %hhd %.3s %*d%%\n", -4, 3.14159, text, 255U, 1ULL << 40, 'z', 7, text, 4,
                    9);
}
int64_t c_property(const char* name);
int64_t c_property(const char* name) {
  return irp_property_integer(name, -1);
}
const char* c_property_text(const char* name);
const char* c_property_text(const char* name) {
  return irp_property_text(name, "none");
}

/* What the header has to repeat from C++. */
const size_t c_ref_layout[] = {
    sizeof(indurop_c_ref),          offsetof(indurop_c_ref, name_hash), offsetof(indurop_c_ref, type_hash),
    offsetof(indurop_c_ref, entry), offsetof(indurop_c_ref, initial),   offsetof(indurop_c_ref, value_size),
    offsetof(indurop_c_ref, kind),  offsetof(indurop_c_ref, name),      INDUROP_C_ABI};
