---- in.glb.c.h
// Shared variables of in.glb for modules in C, written by glb2idl. Do not edit.
#ifndef INDUROP_7ecd5aaad052b6bb
#define INDUROP_7ecd5aaad052b6bb

#include <indurop/module_c.h>

#define cell_AXES (6)
#define cell_LIMIT (0.5)
#define cell_SMALL ((uint8_t)200)
#define cell_FAR ((int64_t)-5000000000)
#define cell_NAME "arm"
typedef int32_t cell_State;
enum { cell_IDLE = 0, cell_MOVING = 1, cell_FAULT = 2 };
typedef struct cell_Pose {
  double x;  // [mm]
  float turn[2][3];
  cell_State state;
  char label[8];
} cell_Pose;
_Static_assert(sizeof(cell_Pose) == 48 && _Alignof(cell_Pose) == 8, "cell::Pose");
_Static_assert(offsetof(cell_Pose, x) == 0, "x");
_Static_assert(offsetof(cell_Pose, turn) == 8, "turn");
_Static_assert(offsetof(cell_Pose, state) == 32, "state");
_Static_assert(offsetof(cell_Pose, label) == 36, "label");
struct irp_value_cell_state { cell_State value; };
#define irp_hash_cell_state UINT64_C(0x3d1172f4612ace96)
#define irp_max_age_ns_cell_state INT64_C(0)
#define irp_ref_cell_state irp_refs_7ecd5aaad052b6bb[0]
struct irp_value_cell_pose { cell_Pose value; };  // where it is
#define irp_hash_cell_pose UINT64_C(0x07bdad4232f21ce4)
#define irp_max_age_ns_cell_pose INT64_C(0)
#define irp_ref_cell_pose irp_refs_7ecd5aaad052b6bb[1]
struct irp_value_cell_tick { uint32_t value; };
#define irp_hash_cell_tick UINT64_C(0x9a045923b9192304)
#define irp_max_age_ns_cell_tick INT64_C(20000000)
#define irp_ref_cell_tick irp_refs_7ecd5aaad052b6bb[2]
struct irp_value_cell_grid { int16_t value[2][6]; };
#define irp_hash_cell_grid UINT64_C(0x76e174a6ce3864b1)
#define irp_max_age_ns_cell_grid INT64_C(0)
#define irp_ref_cell_grid irp_refs_7ecd5aaad052b6bb[3]
struct irp_value_cell_names { char value[2][16]; };
#define irp_hash_cell_names UINT64_C(0xfe64f1470de19ecf)
#define irp_max_age_ns_cell_names INT64_C(0)
#define irp_ref_cell_names irp_refs_7ecd5aaad052b6bb[4]
struct irp_value_cell_ready { bool value; };
#define irp_hash_cell_ready UINT64_C(0xd7e3833a216c9234)
#define irp_max_age_ns_cell_ready INT64_C(0)
#define irp_ref_cell_ready irp_refs_7ecd5aaad052b6bb[5]

_Alignas(8) static const unsigned char irp_initial_cell_state[4] = {
    1,
};
_Alignas(8) static const unsigned char irp_initial_cell_pose[48] = {
    0, 0, 0, 0, 0, 0, 248, 63, 0, 0, 128, 63, 0, 0, 0, 64, 0, 0, 64, 64, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 104, 101, 114, 101,
};
_Alignas(8) static const unsigned char irp_initial_cell_grid[24] = {
    1, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3,
};
static indurop_c_ref irp_refs_7ecd5aaad052b6bb[] = {
    {UINT64_C(0x3d1172f4612ace96), UINT64_C(0x91474411ca48cf94), NULL, irp_initial_cell_state, 4, 0, "cell::state"},
    {UINT64_C(0x07bdad4232f21ce4), UINT64_C(0x3914c2edd382d172), NULL, irp_initial_cell_pose, 48, 1, "cell::pose"},
    {UINT64_C(0x9a045923b9192304), UINT64_C(0x4d2bdf193e8526d1), NULL, NULL, 4, 0, "cell::tick"},
    {UINT64_C(0x76e174a6ce3864b1), UINT64_C(0x89d6d73382aeb05f), NULL, irp_initial_cell_grid, 24, 1, "cell::grid"},
    {UINT64_C(0xfe64f1470de19ecf), UINT64_C(0x192503fbc6345c68), NULL, NULL, 32, 1, "cell::names"},
    {UINT64_C(0xd7e3833a216c9234), UINT64_C(0xcd2fd49bc6b014bd), NULL, NULL, 1, 0, "cell::ready"},
};
__attribute__((constructor(101))) static void irp_bind_7ecd5aaad052b6bb(void) {
  indurop_register_refs(irp_refs_7ecd5aaad052b6bb, 6, INDUROP_C_ABI);
}
__attribute__((destructor(101))) static void irp_unbind_7ecd5aaad052b6bb(void) {
  indurop_unregister_refs(irp_refs_7ecd5aaad052b6bb);
}
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Woverlength-strings"
__asm__(".pushsection .indurop.schema,\"G\",%progbits,indurop_schema_c_7ecd5aaad052b6bb,comdat\n"
        ".ascii \"{\\\"schema\\\":1,\\\"abi\\\":5,\\\"variables\\\":[{\\\"name\\\":\\\"cell::state\\\",\\\"type\\\":{\\\"base\\\":\\\"enum\\\",\\\"name\\\":\\\"cell::State\\\",\\\"v\"\n"
        ".ascii \"alues\\\":[[\\\"IDLE\\\",0],[\\\"MOVING\\\",1],[\\\"FAULT\\\",2]]},\\\"kind\\\":\\\"scalar\\\",\\\"initial\\\":\\\"01000000\\\",\\\"source\\\":\\\"in.glb:\"\n"
        ".ascii \"15\\\"},{\\\"name\\\":\\\"cell::pose\\\",\\\"type\\\":{\\\"base\\\":\\\"struct\\\",\\\"name\\\":\\\"cell::Pose\\\",\\\"size\\\":48,\\\"align\\\":8,\\\"fields\\\":[\"\n"
        ".ascii \"{\\\"name\\\":\\\"x\\\",\\\"type\\\":\\\"double\\\",\\\"offset\\\":0,\\\"unit\\\":\\\"mm\\\"},{\\\"name\\\":\\\"turn\\\",\\\"type\\\":{\\\"base\\\":\\\"float\\\",\\\"dims\\\":[2,\"\n"
        ".ascii \"3]},\\\"offset\\\":8},{\\\"name\\\":\\\"state\\\",\\\"type\\\":{\\\"base\\\":\\\"enum\\\",\\\"name\\\":\\\"cell::State\\\",\\\"values\\\":[[\\\"IDLE\\\",0],[\\\"MO\"\n"
        ".ascii \"VING\\\",1],[\\\"FAULT\\\",2]]},\\\"offset\\\":32},{\\\"name\\\":\\\"label\\\",\\\"type\\\":{\\\"base\\\":\\\"text\\\",\\\"size\\\":8},\\\"offset\\\":36}]},\\\"\"\n"
        ".ascii \"kind\\\":\\\"ring\\\",\\\"description\\\":\\\"where it is\\\",\\\"initial\\\":\\\"000000000000f83f0000803f000000400000404000000000\"\n"
        ".ascii \"000000000000000002000000686572650000000000000000\\\",\\\"source\\\":\\\"in.glb:16\\\"},{\\\"name\\\":\\\"cell::tick\\\",\\\"type\\\":\"\n"
        ".ascii \"\\\"uint32\\\",\\\"kind\\\":\\\"scalar\\\",\\\"maxage_ns\\\":20000000,\\\"source\\\":\\\"in.glb:17\\\"},{\\\"name\\\":\\\"cell::grid\\\",\\\"type\\\":{\\\"ba\"\n"
        ".ascii \"se\\\":\\\"int16\\\",\\\"dims\\\":[2,6]},\\\"kind\\\":\\\"ring\\\",\\\"initial\\\":\\\"010002000000000000000000030000000000000000000000\\\"\"\n"
        ".ascii \",\\\"source\\\":\\\"in.glb:18\\\"},{\\\"name\\\":\\\"cell::names\\\",\\\"type\\\":{\\\"base\\\":\\\"text\\\",\\\"size\\\":16,\\\"dims\\\":[2]},\\\"kind\\\":\\\"rin\"\n"
        ".ascii \"g\\\",\\\"source\\\":\\\"in.glb:19\\\"},{\\\"name\\\":\\\"cell::ready\\\",\\\"type\\\":\\\"bool\\\",\\\"kind\\\":\\\"scalar\\\",\\\"source\\\":\\\"in.glb:20\\\"}],\"\n"
        ".ascii \"\\\"functions\\\":[{\\\"name\\\":\\\"cell::add\\\",\\\"arguments\\\":{\\\"base\\\":\\\"struct\\\",\\\"name\\\":\\\"cell::add_args\\\",\\\"size\\\":16,\\\"ali\"\n"
        ".ascii \"gn\\\":8,\\\"fields\\\":[{\\\"name\\\":\\\"a\\\",\\\"type\\\":\\\"double\\\",\\\"offset\\\":0},{\\\"name\\\":\\\"b\\\",\\\"type\\\":\\\"double\\\",\\\"offset\\\":8}]},\\\"r\"\n"
        ".ascii \"esult\\\":\\\"double\\\",\\\"source\\\":\\\"in.glb:21\\\"}]}\"\n"
        ".ascii \"\\n\"\n.popsection");
#pragma GCC diagnostic pop

#endif
---- indurop/generated.c.h
// All shared variables for modules in C, written by glb2idl. Do not edit.
#include "../in.glb.c.h"
