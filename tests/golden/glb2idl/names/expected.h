// Shared variables of in.glb, written by glb2idl. Do not edit.
#pragma once

#include <indurop/lock.h>
#include <indurop/var.h>

#include <array>
#include <cstddef>
#include <cstdint>

#ifndef INDUROP_LEAF
#define INDUROP_LEAF ::indurop::Leaf
#endif

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_181bee281ae1e2c4,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"demo::Names::all\",\"type\":{\"base\":\"struct\",\"name\":\"demo::Na"
.ascii "mes::All\",\"size\":72,\"align\":8,\"fields\":[{\"name\":\"pos\",\"type\":{\"base\":\"struct\",\"name\":\"demo::Names::P"
.ascii "os\",\"size\":8,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0}]},\"offset\":0},{\"name\":\"home"
.ascii "\",\"type\":\"int32\",\"offset\":8},{\"name\":\"map\",\"type\":\"int32\",\"offset\":12},{\"name\":\"port\",\"type\":\"int32\""
.ascii ",\"offset\":16},{\"name\":\"string\",\"type\":\"int32\",\"offset\":20},{\"name\":\"any\",\"type\":\"int32\",\"offset\":24}"
.ascii ",{\"name\":\"in\",\"type\":\"int32\",\"offset\":28},{\"name\":\"out\",\"type\":\"int32\",\"offset\":32},{\"name\":\"fixed\","
.ascii "\"type\":\"int32\",\"offset\":36},{\"name\":\"sequence\",\"type\":\"int32\",\"offset\":40},{\"name\":\"Default\",\"type\":"
.ascii "\"int32\",\"offset\":44},{\"name\":\"True\",\"type\":\"int32\",\"offset\":48},{\"name\":\"native\",\"type\":\"int32\",\"off"
.ascii "set\":52},{\"name\":\"local\",\"type\":\"int32\",\"offset\":56},{\"name\":\"module\",\"type\":\"int32\",\"offset\":60},{\""
.ascii "name\":\"place\",\"type\":\"bool\",\"offset\":64},{\"name\":\"Tag\",\"type\":\"bool\",\"offset\":65},{\"name\":\"Offset\",\""
.ascii "type\":\"bool\",\"offset\":66},{\"name\":\"f\",\"type\":\"bool\",\"offset\":67},{\"name\":\"v\",\"type\":\"bool\",\"offset\":"
.ascii "68},{\"name\":\"a\",\"type\":\"bool\",\"offset\":69},{\"name\":\"at\",\"type\":\"bool\",\"offset\":70}]},\"kind\":\"ring\",\""
.ascii "source\":\"in.glb:6\"},{\"name\":\"demo::Names::pos\",\"type\":{\"base\":\"struct\",\"name\":\"demo::Names::Pos\",\"si"
.ascii "ze\":8,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0}]},\"kind\":\"ring\",\"source\":\"in.glb:7"
.ascii "\"},{\"name\":\"demo::Names::port\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:8\"},{\"name\":\"demo::Na"
.ascii "mes::home\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:8\"},{\"name\":\"demo::Names::in\",\"type\":\"int"
.ascii "32\",\"kind\":\"scalar\",\"source\":\"in.glb:8\"},{\"name\":\"demo::Names::status\",\"type\":\"int32\",\"kind\":\"scalar"
.ascii "\",\"source\":\"in.glb:8\"},{\"name\":\"demo::Names::error\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:"
.ascii "8\"},{\"name\":\"demo::Names::position\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:8\"},{\"name\":\"dem"
.ascii "o::Names2\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:11\"},{\"name\":\"demo::time\",\"type\":\"int32\","
.ascii "\"kind\":\"scalar\",\"source\":\"in.glb:11\"},{\"name\":\"Other::place\",\"type\":{\"base\":\"struct\",\"name\":\"demo::N"
.ascii "ames::Pos\",\"size\":8,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0}]},\"kind\":\"ring\",\"sou"
.ascii "rce\":\"in.glb:13\"},{\"name\":\"Other::lines\",\"type\":{\"base\":\"int32\",\"dims\":[5]},\"kind\":\"ring\",\"source\":\""
.ascii "in.glb:15\"}]}"
.ascii "\n"
.popsection)indurop");

namespace demo::Names {
struct Pos {
  double x{};
  friend bool operator==(const Pos&, const Pos&) = default;
};
static_assert(sizeof(Pos) == 8 && alignof(Pos) == 8);
static_assert(offsetof(Pos, x) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const Pos& v, indurop_visitor f) {
  f("x", v.x);
}
struct All {
  ::demo::Names::Pos pos{};
  ::std::int32_t home{};
  ::std::int32_t map{};
  ::std::int32_t port{};
  ::std::int32_t string{};
  ::std::int32_t any{};
  ::std::int32_t in{};
  ::std::int32_t out{};
  ::std::int32_t fixed{};
  ::std::int32_t sequence{};
  ::std::int32_t Default{};
  ::std::int32_t True{};
  ::std::int32_t native{};
  ::std::int32_t local{};
  ::std::int32_t module{};
  bool place{};
  bool Tag{};
  bool Offset{};
  bool f{};
  bool v{};
  bool a{};
  bool at{};
  friend bool operator==(const All&, const All&) = default;
};
static_assert(sizeof(All) == 72 && alignof(All) == 8);
static_assert(offsetof(All, pos) == 0);
static_assert(offsetof(All, home) == 8);
static_assert(offsetof(All, map) == 12);
static_assert(offsetof(All, port) == 16);
static_assert(offsetof(All, string) == 20);
static_assert(offsetof(All, any) == 24);
static_assert(offsetof(All, in) == 28);
static_assert(offsetof(All, out) == 32);
static_assert(offsetof(All, fixed) == 36);
static_assert(offsetof(All, sequence) == 40);
static_assert(offsetof(All, Default) == 44);
static_assert(offsetof(All, True) == 48);
static_assert(offsetof(All, native) == 52);
static_assert(offsetof(All, local) == 56);
static_assert(offsetof(All, module) == 60);
static_assert(offsetof(All, place) == 64);
static_assert(offsetof(All, Tag) == 65);
static_assert(offsetof(All, Offset) == 66);
static_assert(offsetof(All, f) == 67);
static_assert(offsetof(All, v) == 68);
static_assert(offsetof(All, a) == 69);
static_assert(offsetof(All, at) == 70);
template <class indurop_visitor>
constexpr void indurop_fields(const All& v, indurop_visitor f) {
  f("pos", v.pos);
  f("home", v.home);
  f("map", v.map);
  f("port", v.port);
  f("string", v.string);
  f("any", v.any);
  f("in", v.in);
  f("out", v.out);
  f("fixed", v.fixed);
  f("sequence", v.sequence);
  f("Default", v.Default);
  f("True", v.True);
  f("native", v.native);
  f("local", v.local);
  f("module", v.module);
  f("place", v.place);
  f("Tag", v.Tag);
  f("Offset", v.Offset);
  f("f", v.f);
  f("v", v.v);
  f("a", v.a);
  f("at", v.at);
}
enum Way : ::std::int32_t { any = 0, object = 1, FINDER = 2 };
}  // namespace demo::Names

namespace Other {
inline constexpr ::std::int32_t string{5};
}  // namespace Other

namespace indurop_generated_181bee281ae1e2c4 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0x4013d69b34e500c1, 0x17cd84581c16d174, nullptr, nullptr, 72, ::indurop::abi::Kind::Ring, "demo::Names::all"},
    {0xac7dfe9ae1356470, 0x38c7f02e5218eb61, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "demo::Names::pos"},
    {0x4f7fab2cadbce5d5, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names::port"},
    {0xae739a6e72faddc5, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names::home"},
    {0xf0c865855bd6ed85, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names::in"},
    {0x606f6d02b0fd5604, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names::status"},
    {0x5fbc653ee6f628fc, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names::error"},
    {0x84c1c112e8cca8c5, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names::position"},
    {0xd9533b5bfa6bc6cc, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::Names2"},
    {0xe14b1f2bea680a1b, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::time"},
    {0x9ac22f12ad41a8bc, 0x38c7f02e5218eb61, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "Other::place"},
    {0xfa371a6e88a7231c, 0xbb2914295c5dc6a0, nullptr, nullptr, 20, ::indurop::abi::Kind::Ring, "Other::lines"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 12, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_demo_Names_all {
  static constexpr ::std::uint64_t kNameHash = 0x4013d69b34e500c1;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 72;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_demo_Names_pos {
  static constexpr ::std::uint64_t kNameHash = 0xac7dfe9ae1356470;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_demo_Names_port {
  static constexpr ::std::uint64_t kNameHash = 0x4f7fab2cadbce5d5;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_demo_Names_home {
  static constexpr ::std::uint64_t kNameHash = 0xae739a6e72faddc5;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_demo_Names_in {
  static constexpr ::std::uint64_t kNameHash = 0xf0c865855bd6ed85;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_demo_Names_status {
  static constexpr ::std::uint64_t kNameHash = 0x606f6d02b0fd5604;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_demo_Names_error {
  static constexpr ::std::uint64_t kNameHash = 0x5fbc653ee6f628fc;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_demo_Names_position {
  static constexpr ::std::uint64_t kNameHash = 0x84c1c112e8cca8c5;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
struct var_demo_Names2 {
  static constexpr ::std::uint64_t kNameHash = 0xd9533b5bfa6bc6cc;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[8]; }
};
struct var_demo_time {
  static constexpr ::std::uint64_t kNameHash = 0xe14b1f2bea680a1b;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[9]; }
};
struct var_Other_place {
  static constexpr ::std::uint64_t kNameHash = 0x9ac22f12ad41a8bc;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[10]; }
};
struct var_Other_lines {
  static constexpr ::std::uint64_t kNameHash = 0xfa371a6e88a7231c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 20;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[11]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_Names_Pos {
  using value_type = ::demo::Names::Pos;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  INDUROP_UNION_SHAPE(ref_demo_Names_Pos)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_Names_All {
  using value_type = ::demo::Names::All;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop_generated_181bee281ae1e2c4::ref_demo_Names_Pos<indurop_tag, indurop_offset + 0> pos;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 8> home;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 12> map;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 16> port;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 20> string;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 24> any;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 28> in;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 32> out;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 36> fixed;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 40> sequence;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 44> Default;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 48> True;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 52> native;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 56> local;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 60> module;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 64> place;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 65> Tag;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 66> Offset;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 67> f;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 68> v;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 69> a;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 70> at;
  INDUROP_UNION_SHAPE(ref_demo_Names_All)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_181bee281ae1e2c4

namespace demo::Names {
inline constexpr ::indurop_generated_181bee281ae1e2c4::ref_demo_Names_All<::indurop_generated_181bee281ae1e2c4::var_demo_Names_all, 0> all{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_181bee281ae1e2c4::ref_demo_Names_Pos<::indurop_generated_181bee281ae1e2c4::var_demo_Names_pos, 0> pos{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names_port, ::std::int32_t, 0> port{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names_home, ::std::int32_t, 0> home{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names_in, ::std::int32_t, 0> in{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names_status, ::std::int32_t, 0> status{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names_error, ::std::int32_t, 0> error{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names_position, ::std::int32_t, 0> position{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace demo::Names

namespace demo {
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_Names2, ::std::int32_t, 0> Names2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_181bee281ae1e2c4::var_demo_time, ::std::int32_t, 0> time{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace demo

namespace Other {
inline constexpr ::indurop_generated_181bee281ae1e2c4::ref_demo_Names_Pos<::indurop_generated_181bee281ae1e2c4::var_Other_place, 0> place{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_181bee281ae1e2c4::var_Other_lines, ::std::int32_t, 0>, 5> lines{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace Other
