// Shared variables of in.glb, written by glb2idl. Do not edit.
#pragma once

#include <indurop/lock.h>
#include <indurop/var.h>
#include <indurop/function.h>

#include <array>
#include <cstddef>
#include <cstdint>

#ifndef INDUROP_LEAF
#define INDUROP_LEAF ::indurop::Leaf
#endif

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_07efed86c1227851,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"cell::state\",\"type\":{\"base\":\"enum\",\"name\":\"cell::State\",\"v"
.ascii "alues\":[[\"IDLE\",0],[\"MOVING\",1],[\"FAULT\",2]]},\"kind\":\"scalar\",\"initial\":\"01000000\",\"source\":\"in.glb:"
.ascii "15\"},{\"name\":\"cell::pose\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Pose\",\"size\":48,\"align\":8,\"fields\":["
.ascii "{\"name\":\"x\",\"type\":\"double\",\"offset\":0,\"unit\":\"mm\"},{\"name\":\"turn\",\"type\":{\"base\":\"float\",\"dims\":[2,"
.ascii "3]},\"offset\":8},{\"name\":\"state\",\"type\":{\"base\":\"enum\",\"name\":\"cell::State\",\"values\":[[\"IDLE\",0],[\"MO"
.ascii "VING\",1],[\"FAULT\",2]]},\"offset\":32},{\"name\":\"label\",\"type\":{\"base\":\"text\",\"size\":8},\"offset\":36}]},\""
.ascii "kind\":\"ring\",\"description\":\"where it is\",\"initial\":\"000000000000f83f0000803f000000400000404000000000"
.ascii "000000000000000002000000686572650000000000000000\",\"source\":\"in.glb:16\"},{\"name\":\"cell::tick\",\"type\":"
.ascii "\"uint32\",\"kind\":\"scalar\",\"maxage_ns\":20000000,\"source\":\"in.glb:17\"},{\"name\":\"cell::grid\",\"type\":{\"ba"
.ascii "se\":\"int16\",\"dims\":[2,6]},\"kind\":\"ring\",\"initial\":\"010002000000000000000000030000000000000000000000\""
.ascii ",\"source\":\"in.glb:18\"},{\"name\":\"cell::names\",\"type\":{\"base\":\"text\",\"size\":16,\"dims\":[2]},\"kind\":\"rin"
.ascii "g\",\"source\":\"in.glb:19\"},{\"name\":\"cell::ready\",\"type\":\"bool\",\"kind\":\"scalar\",\"source\":\"in.glb:20\"}],"
.ascii "\"functions\":[{\"name\":\"cell::add\",\"arguments\":{\"base\":\"struct\",\"name\":\"cell::add_args\",\"size\":16,\"ali"
.ascii "gn\":8,\"fields\":[{\"name\":\"a\",\"type\":\"double\",\"offset\":0},{\"name\":\"b\",\"type\":\"double\",\"offset\":8}]},\"r"
.ascii "esult\":\"double\",\"source\":\"in.glb:21\"}]}"
.ascii "\n"
.popsection)indurop");

namespace cell {
inline constexpr ::std::int32_t AXES{6};
inline constexpr double LIMIT{0.5};
inline constexpr ::std::uint8_t SMALL{200};
inline constexpr ::std::int64_t FAR{-5000000000};
inline constexpr char NAME[] = "arm";
enum State : ::std::int32_t { IDLE = 0, MOVING = 1, FAULT = 2 };
struct Pose {
  double x{};  // [mm]
  ::std::array<::std::array<float, 3>, 2> turn{};
  ::cell::State state{};
  ::indurop::string<8> label{};
  friend bool operator==(const Pose&, const Pose&) = default;
};
static_assert(sizeof(Pose) == 48 && alignof(Pose) == 8);
static_assert(offsetof(Pose, x) == 0);
static_assert(offsetof(Pose, turn) == 8);
static_assert(offsetof(Pose, state) == 32);
static_assert(offsetof(Pose, label) == 36);
template <class indurop_visitor>
constexpr void indurop_fields(const Pose& v, indurop_visitor f) {
  f("x", v.x);
  f("turn", v.turn);
  f("state", v.state);
  f("label", v.label);
}
struct add_args {
  double a{};
  double b{};
};
static_assert(sizeof(add_args) == 16 && alignof(add_args) == 8);
static_assert(offsetof(add_args, a) == 0);
static_assert(offsetof(add_args, b) == 8);
}  // namespace cell

namespace indurop_generated_07efed86c1227851 __attribute__((visibility("hidden"))) {
inline constexpr ::cell::State initial_cell_state{::cell::MOVING};
inline constexpr ::cell::Pose initial_cell_pose{1.5, {{{{1.0F, 2.0F, 3.0F}}}}, ::cell::FAULT, "here"};
inline constexpr ::std::array<::std::array<::std::int16_t, 6>, 2> initial_cell_grid{{{{1, 2}}, {{3}}}};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x3d1172f4612ace96, 0x91474411ca48cf94, nullptr, &initial_cell_state, 4, ::indurop::abi::Kind::Scalar, "cell::state"},
    {0x07bdad4232f21ce4, 0x3914c2edd382d172, nullptr, &initial_cell_pose, 48, ::indurop::abi::Kind::Ring, "cell::pose"},
    {0x9a045923b9192304, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "cell::tick"},
    {0x76e174a6ce3864b1, 0x89d6d73382aeb05f, nullptr, &initial_cell_grid, 24, ::indurop::abi::Kind::Ring, "cell::grid"},
    {0xfe64f1470de19ecf, 0x192503fbc6345c68, nullptr, nullptr, 32, ::indurop::abi::Kind::Ring, "cell::names"},
    {0xd7e3833a216c9234, 0xcd2fd49bc6b014bd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "cell::ready"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 6, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_cell_state {
  static constexpr ::std::uint64_t kNameHash = 0x3d1172f4612ace96;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_cell_pose {
  static constexpr ::std::uint64_t kNameHash = 0x07bdad4232f21ce4;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 48;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_cell_tick {
  static constexpr ::std::uint64_t kNameHash = 0x9a045923b9192304;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  static constexpr ::std::int64_t kMaxAgeNs = 20000000;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_cell_grid {
  static constexpr ::std::uint64_t kNameHash = 0x76e174a6ce3864b1;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 24;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_cell_names {
  static constexpr ::std::uint64_t kNameHash = 0xfe64f1470de19ecf;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 32;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_cell_ready {
  static constexpr ::std::uint64_t kNameHash = 0xd7e3833a216c9234;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Pose {
  using value_type = ::cell::Pose;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<indurop_tag, float, indurop_offset + 8>, 3>, 2> turn;
  ::indurop::Leaf<indurop_tag, ::cell::State, indurop_offset + 32> state;
  ::indurop::Text<indurop_tag, 8, indurop_offset + 36> label;
  INDUROP_UNION_SHAPE(ref_cell_Pose)
  INDUROP_FRESHNESS(indurop_tag)
};
struct fn_cell_add {
  using args = ::cell::add_args;
  using result = double;
  static constexpr const char* kName = "cell::add";
  static constexpr ::std::uint64_t kNameHash = 0xaac1b658b31e47d4;
  static constexpr ::std::uint64_t kTypeHash = 0x23a1eb27e2769180;
  static constexpr ::std::int64_t kDeadlineNs = 0;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.a, a.b);
  }
};
}  // namespace indurop_generated_07efed86c1227851

namespace cell {
inline constexpr INDUROP_LEAF<::indurop_generated_07efed86c1227851::var_cell_state, ::cell::State, 0> state{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_07efed86c1227851::ref_cell_Pose<::indurop_generated_07efed86c1227851::var_cell_pose, 0> pose{::indurop::Place{0}, ::indurop::detail::Make{}};  // where it is
inline constexpr INDUROP_LEAF<::indurop_generated_07efed86c1227851::var_cell_tick, ::std::uint32_t, 0> tick{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_07efed86c1227851::var_cell_grid, ::std::int16_t, 0>, 6>, 2> grid{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Text<::indurop_generated_07efed86c1227851::var_cell_names, 16, 0>, 2> names{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_07efed86c1227851::var_cell_ready, bool, 0> ready{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::Function<::indurop_generated_07efed86c1227851::fn_cell_add, double(double, double)> add{};
}  // namespace cell
