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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_5e95f91691edae84,comdat
.ascii "{\"schema\":1,\"abi\":5,\"functions\":[{\"name\":\"demo::add\",\"arguments\":{\"base\":\"struct\",\"name\":\"demo::add_"
.ascii "args\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"a\",\"type\":\"double\",\"offset\":0},{\"name\":\"b\",\"type\":\"doub"
.ascii "le\",\"offset\":8}]},\"result\":\"double\",\"deadline_ns\":5000000,\"description\":\"adds two numbers\",\"source\":"
.ascii "\"in.glb:4\"},{\"name\":\"demo::reset\",\"arguments\":{\"base\":\"struct\",\"name\":\"demo::reset_args\",\"size\":0,\"a"
.ascii "lign\":1,\"fields\":[]},\"result\":{\"base\":\"struct\",\"size\":0,\"align\":1,\"fields\":[]},\"source\":\"in.glb:5\"},"
.ascii "{\"name\":\"demo::stop_now\",\"arguments\":{\"base\":\"struct\",\"name\":\"demo::stop_now_args\",\"size\":0,\"align\":"
.ascii "1,\"fields\":[]},\"result\":{\"base\":\"struct\",\"size\":0,\"align\":1,\"fields\":[]},\"description\":\"stops the ax"
.ascii "is\",\"source\":\"in.glb:6\"},{\"name\":\"demo::unnamed\",\"arguments\":{\"base\":\"struct\",\"name\":\"demo::unnamed_"
.ascii "args\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"arg1\",\"type\":\"int32\",\"offset\":0},{\"name\":\"arg2\",\"type\":\""
.ascii "bool\",\"offset\":4}]},\"result\":\"int32\",\"deadline_ns\":100000,\"source\":\"in.glb:7\"},{\"name\":\"demo::move\","
.ascii "\"arguments\":{\"base\":\"struct\",\"name\":\"demo::move_args\",\"size\":56,\"align\":8,\"fields\":[{\"name\":\"from\",\""
.ascii "type\":{\"base\":\"struct\",\"name\":\"demo::P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"o"
.ascii "ffset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"offset\":0},{\"name\":\"mode\",\"type\":{\"base\":\"enum\""
.ascii ",\"name\":\"demo::Mode\",\"values\":[[\"OFF\",0],[\"ON\",1]]},\"offset\":16},{\"name\":\"name\",\"type\":{\"base\":\"text"
.ascii "\",\"size\":8},\"offset\":20},{\"name\":\"by\",\"type\":{\"base\":\"double\",\"dims\":[3]},\"offset\":32}]},\"result\":{\""
.ascii "base\":\"struct\",\"name\":\"demo::P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0"
.ascii "},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"deadline_ns\":1000000000,\"source\":\"in.glb:8\"},{\"name\":\"d"
.ascii "emo::no_variables_needed\",\"arguments\":{\"base\":\"struct\",\"name\":\"demo::no_variables_needed_args\",\"size"
.ascii "\":0,\"align\":1,\"fields\":[]},\"result\":\"float\",\"source\":\"in.glb:9\"}]}"
.ascii "\n"
.popsection)indurop");

namespace demo {
struct P {
  double x{};
  double y{};
  friend bool operator==(const P&, const P&) = default;
};
static_assert(sizeof(P) == 16 && alignof(P) == 8);
static_assert(offsetof(P, x) == 0);
static_assert(offsetof(P, y) == 8);
template <class indurop_visitor>
constexpr void indurop_fields(const P& v, indurop_visitor f) {
  f("x", v.x);
  f("y", v.y);
}
enum Mode : ::std::int32_t { OFF = 0, ON = 1 };
struct add_args {
  double a{};
  double b{};
};
static_assert(sizeof(add_args) == 16 && alignof(add_args) == 8);
static_assert(offsetof(add_args, a) == 0);
static_assert(offsetof(add_args, b) == 8);
struct reset_args {
};
struct stop_now_args {
};
struct unnamed_args {
  ::std::int32_t arg1{};
  bool arg2{};
};
static_assert(sizeof(unnamed_args) == 8 && alignof(unnamed_args) == 4);
static_assert(offsetof(unnamed_args, arg1) == 0);
static_assert(offsetof(unnamed_args, arg2) == 4);
struct move_args {
  ::demo::P from{};
  ::demo::Mode mode{};
  ::indurop::string<8> name{};
  ::std::array<double, 3> by{};
};
static_assert(sizeof(move_args) == 56 && alignof(move_args) == 8);
static_assert(offsetof(move_args, from) == 0);
static_assert(offsetof(move_args, mode) == 16);
static_assert(offsetof(move_args, name) == 20);
static_assert(offsetof(move_args, by) == 32);
struct no_variables_needed_args {
};
}  // namespace demo

namespace indurop_generated_5e95f91691edae84 __attribute__((visibility("hidden"))) {
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_P {
  using value_type = ::demo::P;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 8> y;
  INDUROP_UNION_SHAPE(ref_demo_P)
  INDUROP_FRESHNESS(indurop_tag)
};
struct fn_demo_add {
  using args = ::demo::add_args;
  using result = double;
  static constexpr const char* kName = "demo::add";
  static constexpr ::std::uint64_t kNameHash = 0x374fe9979ae2a381;
  static constexpr ::std::uint64_t kTypeHash = 0x23a1eb27e2769180;
  static constexpr ::std::int64_t kDeadlineNs = 5000000;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.a, a.b);
  }
};
struct fn_demo_reset {
  using args = ::demo::reset_args;
  using result = void;
  static constexpr const char* kName = "demo::reset";
  static constexpr ::std::uint64_t kNameHash = 0x0797ce2fdca0439d;
  static constexpr ::std::uint64_t kTypeHash = 0x321967f729bcee13;
  static constexpr ::std::int64_t kDeadlineNs = 0;
  template <class F>
  static result apply(F&& f, const args& /*none*/) {
    return f();
  }
};
struct fn_demo_stop_now {
  using args = ::demo::stop_now_args;
  using result = void;
  static constexpr const char* kName = "demo::stop_now";
  static constexpr ::std::uint64_t kNameHash = 0x30fb49c48103aa21;
  static constexpr ::std::uint64_t kTypeHash = 0x321967f729bcee13;
  static constexpr ::std::int64_t kDeadlineNs = 0;
  template <class F>
  static result apply(F&& f, const args& /*none*/) {
    return f();
  }
};
struct fn_demo_unnamed {
  using args = ::demo::unnamed_args;
  using result = ::std::int32_t;
  static constexpr const char* kName = "demo::unnamed";
  static constexpr ::std::uint64_t kNameHash = 0x6b1dbf8703d8f252;
  static constexpr ::std::uint64_t kTypeHash = 0x3e4f0812cb871cfd;
  static constexpr ::std::int64_t kDeadlineNs = 100000;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.arg1, a.arg2);
  }
};
struct fn_demo_move {
  using args = ::demo::move_args;
  using result = ::demo::P;
  static constexpr const char* kName = "demo::move";
  static constexpr ::std::uint64_t kNameHash = 0x3b7071799f2b1577;
  static constexpr ::std::uint64_t kTypeHash = 0x3522e6535e819641;
  static constexpr ::std::int64_t kDeadlineNs = 1000000000;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.from, a.mode, a.name, a.by);
  }
};
struct fn_demo_no_variables_needed {
  using args = ::demo::no_variables_needed_args;
  using result = float;
  static constexpr const char* kName = "demo::no_variables_needed";
  static constexpr ::std::uint64_t kNameHash = 0x157b1e3a471be505;
  static constexpr ::std::uint64_t kTypeHash = 0x2f5d16cc77cabcb0;
  static constexpr ::std::int64_t kDeadlineNs = 0;
  template <class F>
  static result apply(F&& f, const args& /*none*/) {
    return f();
  }
};
}  // namespace indurop_generated_5e95f91691edae84

namespace demo {
inline constexpr ::indurop::Function<::indurop_generated_5e95f91691edae84::fn_demo_add, double(double, double)> add{};  // adds two numbers
inline constexpr ::indurop::Function<::indurop_generated_5e95f91691edae84::fn_demo_reset, void()> reset{};
inline constexpr ::indurop::Function<::indurop_generated_5e95f91691edae84::fn_demo_stop_now, void()> stop_now{};  // stops the axis
inline constexpr ::indurop::Function<::indurop_generated_5e95f91691edae84::fn_demo_unnamed, ::std::int32_t(::std::int32_t, bool)> unnamed{};
inline constexpr ::indurop::Function<::indurop_generated_5e95f91691edae84::fn_demo_move, ::demo::P(::demo::P, ::demo::Mode, ::indurop::string<8>, ::std::array<double, 3>)> move{};
inline constexpr ::indurop::Function<::indurop_generated_5e95f91691edae84::fn_demo_no_variables_needed, float()> no_variables_needed{};
}  // namespace demo
