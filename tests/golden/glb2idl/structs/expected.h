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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_1ec35b10281a18d8,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"pair_of_points\",\"type\":{\"base\":\"struct\",\"name\":\"Pair\",\"siz"
.ascii "e\":64,\"align\":8,\"fields\":[{\"name\":\"a\",\"type\":{\"base\":\"struct\",\"name\":\"P\",\"size\":16,\"align\":8,\"fields"
.ascii "\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"offset\":0},{\"n"
.ascii "ame\":\"b\",\"type\":{\"base\":\"struct\",\"name\":\"P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double"
.ascii "\",\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"offset\":16},{\"name\":\"both\",\"type\":{\"base\":\""
.ascii "struct\",\"name\":\"P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0},{\"name\":\"y\""
.ascii ",\"type\":\"double\",\"offset\":8}],\"dims\":[2]},\"offset\":32}]},\"kind\":\"ring\",\"source\":\"in.glb:3\"},{\"name\":"
.ascii "\"box\",\"type\":{\"base\":\"struct\",\"name\":\"box_t\",\"size\":20,\"align\":4,\"fields\":[{\"name\":\"inner\",\"type\":{\""
.ascii "base\":\"struct\",\"name\":\"box_inner_t\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"a\",\"type\":\"int32\",\"offset\""
.ascii ":0},{\"name\":\"on\",\"type\":\"bool\",\"offset\":4}],\"dims\":[2]},\"offset\":0},{\"name\":\"tail\",\"type\":{\"base\":\"s"
.ascii "truct\",\"name\":\"box_tail_t\",\"size\":4,\"align\":1,\"fields\":[{\"name\":\"unit\",\"type\":{\"base\":\"text\",\"size\":"
.ascii "4},\"offset\":0}]},\"offset\":16}]},\"kind\":\"ring\",\"source\":\"in.glb:4\"},{\"name\":\"bodies\",\"type\":{\"base\":\""
.ascii "struct\",\"name\":\"Body\",\"size\":128,\"align\":8,\"fields\":[{\"name\":\"at\",\"type\":{\"base\":\"double\",\"dims\":[3]"
.ascii "},\"offset\":0},{\"name\":\"turn\",\"type\":{\"base\":\"double\",\"dims\":[3,3]},\"offset\":24},{\"name\":\"names\",\"typ"
.ascii "e\":{\"base\":\"text\",\"size\":16,\"dims\":[2]},\"offset\":96}],\"dims\":[3]},\"kind\":\"ring\",\"source\":\"in.glb:11\""
.ascii "},{\"name\":\"origin\",\"type\":{\"base\":\"struct\",\"name\":\"P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"typ"
.ascii "e\":\"double\",\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"kind\":\"ring\",\"source\":\"in.glb:12\""
.ascii "},{\"name\":\"window\",\"type\":{\"base\":\"struct\",\"name\":\"Frame\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"size"
.ascii "\",\"type\":{\"base\":\"struct\",\"name\":\"Size\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"w\",\"type\":\"float\",\"off"
.ascii "set\":0},{\"name\":\"h\",\"type\":\"float\",\"offset\":4}]},\"offset\":0}]},\"kind\":\"ring\",\"source\":\"in.glb:13\"},{"
.ascii "\"name\":\"turn\",\"type\":{\"base\":\"double\",\"dims\":[3,3]},\"kind\":\"ring\",\"source\":\"in.glb:14\"},{\"name\":\"mod"
.ascii "e\",\"type\":{\"base\":\"struct\",\"name\":\"mode_type\",\"size\":4,\"align\":4,\"fields\":[{\"name\":\"value\",\"type\":\"i"
.ascii "nt32\",\"offset\":0}]},\"kind\":\"ring\",\"source\":\"in.glb:15\"},{\"name\":\"states\",\"type\":{\"base\":\"struct\",\"na"
.ascii "me\":\"states_t\",\"size\":4,\"align\":4,\"fields\":[{\"name\":\"value\",\"type\":\"int32\",\"offset\":0}],\"dims\":[2]},"
.ascii "\"kind\":\"ring\",\"source\":\"in.glb:16\"},{\"name\":\"more_states\",\"type\":{\"base\":\"struct\",\"name\":\"states_t\","
.ascii "\"size\":4,\"align\":4,\"fields\":[{\"name\":\"value\",\"type\":\"int32\",\"offset\":0}]},\"kind\":\"ring\",\"source\":\"in"
.ascii ".glb:16\"},{\"name\":\"behind_a_struct_without_semicolon\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.gl"
.ascii "b:18\"}]}"
.ascii "\n"
.popsection)indurop");
struct P {  // a point
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
struct Pair {
  ::P a{};
  ::P b{};
  ::std::array<::P, 2> both{};
  friend bool operator==(const Pair&, const Pair&) = default;
};
static_assert(sizeof(Pair) == 64 && alignof(Pair) == 8);
static_assert(offsetof(Pair, a) == 0);
static_assert(offsetof(Pair, b) == 16);
static_assert(offsetof(Pair, both) == 32);
template <class indurop_visitor>
constexpr void indurop_fields(const Pair& v, indurop_visitor f) {
  f("a", v.a);
  f("b", v.b);
  f("both", v.both);
}
struct box_inner_t {
  ::std::int32_t a{};
  bool on{};
  friend bool operator==(const box_inner_t&, const box_inner_t&) = default;
};
static_assert(sizeof(box_inner_t) == 8 && alignof(box_inner_t) == 4);
static_assert(offsetof(box_inner_t, a) == 0);
static_assert(offsetof(box_inner_t, on) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const box_inner_t& v, indurop_visitor f) {
  f("a", v.a);
  f("on", v.on);
}
struct box_tail_t {
  ::indurop::string<4> unit{};
  friend bool operator==(const box_tail_t&, const box_tail_t&) = default;
};
static_assert(sizeof(box_tail_t) == 4 && alignof(box_tail_t) == 1);
static_assert(offsetof(box_tail_t, unit) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const box_tail_t& v, indurop_visitor f) {
  f("unit", v.unit);
}
struct box_t {
  ::std::array<::box_inner_t, 2> inner{};
  ::box_tail_t tail{};
  friend bool operator==(const box_t&, const box_t&) = default;
};
static_assert(sizeof(box_t) == 20 && alignof(box_t) == 4);
static_assert(offsetof(box_t, inner) == 0);
static_assert(offsetof(box_t, tail) == 16);
template <class indurop_visitor>
constexpr void indurop_fields(const box_t& v, indurop_visitor f) {
  f("inner", v.inner);
  f("tail", v.tail);
}
struct Size {
  float w{};
  float h{};
  friend bool operator==(const Size&, const Size&) = default;
};
static_assert(sizeof(Size) == 8 && alignof(Size) == 4);
static_assert(offsetof(Size, w) == 0);
static_assert(offsetof(Size, h) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const Size& v, indurop_visitor f) {
  f("w", v.w);
  f("h", v.h);
}
struct Frame {
  ::Size size{};
  friend bool operator==(const Frame&, const Frame&) = default;
};
static_assert(sizeof(Frame) == 8 && alignof(Frame) == 4);
static_assert(offsetof(Frame, size) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const Frame& v, indurop_visitor f) {
  f("size", v.size);
}
using Window = ::Frame;
using vec3 = ::std::array<double, 3>;
using mat3 = ::std::array<::std::array<double, 3>, 3>;
using label = ::indurop::string<16>;
struct Body {
  ::std::array<double, 3> at{};
  ::std::array<::std::array<double, 3>, 3> turn{};
  ::std::array<::indurop::string<16>, 2> names{};
  friend bool operator==(const Body&, const Body&) = default;
};
static_assert(sizeof(Body) == 128 && alignof(Body) == 8);
static_assert(offsetof(Body, at) == 0);
static_assert(offsetof(Body, turn) == 24);
static_assert(offsetof(Body, names) == 96);
template <class indurop_visitor>
constexpr void indurop_fields(const Body& v, indurop_visitor f) {
  f("at", v.at);
  f("turn", v.turn);
  f("names", v.names);
}
struct mode_type {
  ::std::int32_t value{};
  friend bool operator==(const mode_type&, const mode_type&) = default;
};
static_assert(sizeof(mode_type) == 4 && alignof(mode_type) == 4);
static_assert(offsetof(mode_type, value) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const mode_type& v, indurop_visitor f) {
  f("value", v.value);
}
struct states_t {
  ::std::int32_t value{};
  friend bool operator==(const states_t&, const states_t&) = default;
};
static_assert(sizeof(states_t) == 4 && alignof(states_t) == 4);
static_assert(offsetof(states_t, value) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const states_t& v, indurop_visitor f) {
  f("value", v.value);
}
struct Late {
  ::std::int32_t a{};
  friend bool operator==(const Late&, const Late&) = default;
};
static_assert(sizeof(Late) == 4 && alignof(Late) == 4);
static_assert(offsetof(Late, a) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const Late& v, indurop_visitor f) {
  f("a", v.a);
}

namespace indurop_generated_1ec35b10281a18d8 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0x7909104d230843e3, 0xcb8fd003c8f57539, nullptr, nullptr, 64, ::indurop::abi::Kind::Ring, "pair_of_points"},
    {0x004d2e191349e4f2, 0xfc489beff4b7e77f, nullptr, nullptr, 20, ::indurop::abi::Kind::Ring, "box"},
    {0xfb08a9c9539a7269, 0x37d4dc5abbf0ed1a, nullptr, nullptr, 384, ::indurop::abi::Kind::Ring, "bodies"},
    {0xb9eae4fe785a14cf, 0x4b12722cf7960421, nullptr, nullptr, 16, ::indurop::abi::Kind::Ring, "origin"},
    {0x71f304ea62c01cbd, 0x3f0753a43aa7cdc3, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "window"},
    {0x869a8aef69c67efa, 0x8ecdb7bb3abd605d, nullptr, nullptr, 72, ::indurop::abi::Kind::Ring, "turn"},
    {0x0d3deba2c41dadb2, 0x4cc6ceb43ffe5160, nullptr, nullptr, 4, ::indurop::abi::Kind::Ring, "mode"},
    {0xc50c696d6cf06e9f, 0x892cb1a54c45d05c, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "states"},
    {0xfad58a3cb3303ca7, 0x4cc6ceb43ffe5160, nullptr, nullptr, 4, ::indurop::abi::Kind::Ring, "more_states"},
    {0xc9d146f7eaabe962, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "behind_a_struct_without_semicolon"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 10, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_pair_of_points {
  static constexpr ::std::uint64_t kNameHash = 0x7909104d230843e3;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 64;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_box {
  static constexpr ::std::uint64_t kNameHash = 0x004d2e191349e4f2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 20;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_bodies {
  static constexpr ::std::uint64_t kNameHash = 0xfb08a9c9539a7269;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 384;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_origin {
  static constexpr ::std::uint64_t kNameHash = 0xb9eae4fe785a14cf;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_window {
  static constexpr ::std::uint64_t kNameHash = 0x71f304ea62c01cbd;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_turn {
  static constexpr ::std::uint64_t kNameHash = 0x869a8aef69c67efa;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 72;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_mode {
  static constexpr ::std::uint64_t kNameHash = 0x0d3deba2c41dadb2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_states {
  static constexpr ::std::uint64_t kNameHash = 0xc50c696d6cf06e9f;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
struct var_more_states {
  static constexpr ::std::uint64_t kNameHash = 0xfad58a3cb3303ca7;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[8]; }
};
struct var_behind_a_struct_without_semicolon {
  static constexpr ::std::uint64_t kNameHash = 0xc9d146f7eaabe962;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[9]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_P {
  using value_type = ::P;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 8> y;
  INDUROP_UNION_SHAPE(ref_P)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_Pair {
  using value_type = ::Pair;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop_generated_1ec35b10281a18d8::ref_P<indurop_tag, indurop_offset + 0> a;
  ::indurop_generated_1ec35b10281a18d8::ref_P<indurop_tag, indurop_offset + 16> b;
  ::indurop::ArrayRef<::indurop_generated_1ec35b10281a18d8::ref_P<indurop_tag, indurop_offset + 32>, 2> both;
  INDUROP_UNION_SHAPE(ref_Pair)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_box_inner_t {
  using value_type = ::box_inner_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> a;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 4> on;
  INDUROP_UNION_SHAPE(ref_box_inner_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_box_tail_t {
  using value_type = ::box_tail_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Text<indurop_tag, 4, indurop_offset + 0> unit;
  INDUROP_UNION_SHAPE(ref_box_tail_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_box_t {
  using value_type = ::box_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::ArrayRef<::indurop_generated_1ec35b10281a18d8::ref_box_inner_t<indurop_tag, indurop_offset + 0>, 2> inner;
  ::indurop_generated_1ec35b10281a18d8::ref_box_tail_t<indurop_tag, indurop_offset + 16> tail;
  INDUROP_UNION_SHAPE(ref_box_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_Size {
  using value_type = ::Size;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 0> w;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 4> h;
  INDUROP_UNION_SHAPE(ref_Size)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_Frame {
  using value_type = ::Frame;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop_generated_1ec35b10281a18d8::ref_Size<indurop_tag, indurop_offset + 0> size;
  INDUROP_UNION_SHAPE(ref_Frame)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_Body {
  using value_type = ::Body;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, double, indurop_offset + 0>, 3> at;
  ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<indurop_tag, double, indurop_offset + 24>, 3>, 3> turn;
  ::indurop::ArrayRef<::indurop::Text<indurop_tag, 16, indurop_offset + 96>, 2> names;
  INDUROP_UNION_SHAPE(ref_Body)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_mode_type {
  using value_type = ::mode_type;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> value;
  INDUROP_UNION_SHAPE(ref_mode_type)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_states_t {
  using value_type = ::states_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> value;
  INDUROP_UNION_SHAPE(ref_states_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_Late {
  using value_type = ::Late;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> a;
  INDUROP_UNION_SHAPE(ref_Late)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_1ec35b10281a18d8
inline constexpr ::indurop_generated_1ec35b10281a18d8::ref_Pair<::indurop_generated_1ec35b10281a18d8::var_pair_of_points, 0> pair_of_points{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_1ec35b10281a18d8::ref_box_t<::indurop_generated_1ec35b10281a18d8::var_box, 0> box{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_1ec35b10281a18d8::ref_Body<::indurop_generated_1ec35b10281a18d8::var_bodies, 0>, 3> bodies{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_1ec35b10281a18d8::ref_P<::indurop_generated_1ec35b10281a18d8::var_origin, 0> origin{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_1ec35b10281a18d8::ref_Frame<::indurop_generated_1ec35b10281a18d8::var_window, 0> window{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_1ec35b10281a18d8::var_turn, double, 0>, 3>, 3> turn{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_1ec35b10281a18d8::ref_mode_type<::indurop_generated_1ec35b10281a18d8::var_mode, 0> mode{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_1ec35b10281a18d8::ref_states_t<::indurop_generated_1ec35b10281a18d8::var_states, 0>, 2> states{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_1ec35b10281a18d8::ref_states_t<::indurop_generated_1ec35b10281a18d8::var_more_states, 0> more_states{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_1ec35b10281a18d8::var_behind_a_struct_without_semicolon, ::std::int32_t, 0> behind_a_struct_without_semicolon{::indurop::Place{0}, ::indurop::detail::Make{}};
