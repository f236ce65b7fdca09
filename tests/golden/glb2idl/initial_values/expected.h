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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_4e3c987a9dfecd45,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"demo::a\",\"type\":\"int32\",\"kind\":\"scalar\",\"initial\":\"0500000"
.ascii "0\",\"source\":\"in.glb:3\"},{\"name\":\"demo::zero\",\"type\":\"int32\",\"kind\":\"scalar\",\"given\":true,\"source\":\"i"
.ascii "n.glb:4\"},{\"name\":\"demo::least8\",\"type\":\"int8\",\"kind\":\"scalar\",\"initial\":\"80\",\"source\":\"in.glb:5\"},{"
.ascii "\"name\":\"demo::least64\",\"type\":\"int64\",\"kind\":\"scalar\",\"initial\":\"0000000000000080\",\"source\":\"in.glb:"
.ascii "6\"},{\"name\":\"demo::most64\",\"type\":\"uint64\",\"kind\":\"scalar\",\"initial\":\"ffffffffffffffff\",\"source\":\"in"
.ascii ".glb:7\"},{\"name\":\"demo::hex\",\"type\":\"uint32\",\"kind\":\"scalar\",\"initial\":\"efbeadde\",\"source\":\"in.glb:8"
.ascii "\"},{\"name\":\"demo::f\",\"type\":\"float\",\"kind\":\"scalar\",\"initial\":\"cdcccc3d\",\"source\":\"in.glb:9\"},{\"name"
.ascii "\":\"demo::g\",\"type\":\"float\",\"kind\":\"scalar\",\"initial\":\"ec78ad60\",\"source\":\"in.glb:9\"},{\"name\":\"demo::"
.ascii "h\",\"type\":\"float\",\"kind\":\"scalar\",\"initial\":\"000000c0\",\"source\":\"in.glb:9\"},{\"name\":\"demo::d\",\"type\""
.ascii ":\"double\",\"kind\":\"scalar\",\"initial\":\"59f3f8c21f6ea501\",\"source\":\"in.glb:10\"},{\"name\":\"demo::whole\",\""
.ascii "type\":\"double\",\"kind\":\"scalar\",\"initial\":\"0000000000000840\",\"source\":\"in.glb:10\"},{\"name\":\"demo::yes"
.ascii "\",\"type\":\"bool\",\"kind\":\"scalar\",\"initial\":\"01\",\"source\":\"in.glb:11\"},{\"name\":\"demo::no\",\"type\":\"bool"
.ascii "\",\"kind\":\"scalar\",\"given\":true,\"source\":\"in.glb:11\"},{\"name\":\"demo::letter\",\"type\":\"char\",\"kind\":\"sc"
.ascii "alar\",\"initial\":\"78\",\"source\":\"in.glb:12\"},{\"name\":\"demo::text\",\"type\":{\"base\":\"text\",\"size\":16},\"ki"
.ascii "nd\":\"ring\",\"initial\":\"616263202271756f7465642220095c00\",\"source\":\"in.glb:13\"},{\"name\":\"demo::sized\","
.ascii "\"type\":{\"base\":\"text\",\"size\":7},\"kind\":\"ring\",\"initial\":\"6cc3a46e676500\",\"source\":\"in.glb:14\"},{\"nam"
.ascii "e\":\"demo::numbers\",\"type\":{\"base\":\"int32\",\"dims\":[3]},\"kind\":\"ring\",\"initial\":\"010000000200000003000"
.ascii "000\",\"source\":\"in.glb:15\"},{\"name\":\"demo::table\",\"type\":{\"base\":\"int32\",\"dims\":[3,2]},\"kind\":\"ring\","
.ascii "\"initial\":\"010000000200000000000000000000000500000000000000\",\"source\":\"in.glb:16\"},{\"name\":\"demo::p\""
.ascii ",\"type\":{\"base\":\"struct\",\"name\":\"demo::P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\","
.ascii "\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"kind\":\"ring\",\"initial\":\"000000000000f03f00000"
.ascii "000000000c0\",\"source\":\"in.glb:17\"},{\"name\":\"demo::ps\",\"type\":{\"base\":\"struct\",\"name\":\"demo::P\",\"size"
.ascii "\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset"
.ascii "\":8}],\"dims\":[4]},\"kind\":\"ring\",\"initial\":\"000000000000f03f00000000000000000000000000000040000000000"
.ascii "00008400000000000000000000000000000000000000000000000000000000000000000\",\"source\":\"in.glb:17\"},{\"nam"
.ascii "e\":\"demo::names\",\"type\":{\"base\":\"text\",\"size\":8,\"dims\":[3]},\"kind\":\"ring\",\"initial\":\"6f6e65000000000"
.ascii "000000000000000007468726565000000\",\"source\":\"in.glb:18\"},{\"name\":\"demo::nested\",\"type\":{\"base\":\"stru"
.ascii "ct\",\"name\":\"demo::nested_t\",\"size\":32,\"align\":8,\"fields\":[{\"name\":\"p\",\"type\":{\"base\":\"struct\",\"name\""
.ascii ":\"demo::P\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0},{\"name\":\"y\",\"type\":"
.ascii "\"double\",\"offset\":8}]},\"offset\":0},{\"name\":\"n\",\"type\":{\"base\":\"int32\",\"dims\":[2]},\"offset\":16},{\"nam"
.ascii "e\":\"on\",\"type\":\"bool\",\"offset\":24}]},\"kind\":\"ring\",\"initial\":\"000000000000f03f0000000000000040030000"
.ascii "00040000000100000000000000\",\"source\":\"in.glb:19\"},{\"name\":\"demo::braces\",\"type\":\"int32\",\"kind\":\"scal"
.ascii "ar\",\"initial\":\"07000000\",\"source\":\"in.glb:20\"}]}"
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
struct nested_t {
  ::demo::P p{};
  ::std::array<::std::int32_t, 2> n{};
  bool on{};
  friend bool operator==(const nested_t&, const nested_t&) = default;
};
static_assert(sizeof(nested_t) == 32 && alignof(nested_t) == 8);
static_assert(offsetof(nested_t, p) == 0);
static_assert(offsetof(nested_t, n) == 16);
static_assert(offsetof(nested_t, on) == 24);
template <class indurop_visitor>
constexpr void indurop_fields(const nested_t& v, indurop_visitor f) {
  f("p", v.p);
  f("n", v.n);
  f("on", v.on);
}
}  // namespace demo

namespace indurop_generated_4e3c987a9dfecd45 __attribute__((visibility("hidden"))) {
inline constexpr ::std::int32_t initial_demo_a{5};
inline constexpr ::std::int8_t initial_demo_least8{-128};
inline constexpr ::std::int64_t initial_demo_least64{INT64_MIN};
inline constexpr ::std::uint64_t initial_demo_most64{18446744073709551615U};
inline constexpr ::std::uint32_t initial_demo_hex{3735928559U};
inline constexpr float initial_demo_f{0.1F};
inline constexpr float initial_demo_g{1e+20F};
inline constexpr float initial_demo_h{-2.0F};
inline constexpr double initial_demo_d{1e-300};
inline constexpr double initial_demo_whole{3.0};
inline constexpr bool initial_demo_yes{true};
inline constexpr char initial_demo_letter{120};
inline constexpr ::indurop::string<16> initial_demo_text{"abc \"quoted\" \011\\"};
inline constexpr ::indurop::string<7> initial_demo_sized{"l\303\244nge"};
inline constexpr ::std::array<::std::int32_t, 3> initial_demo_numbers{{1, 2, 3}};
inline constexpr ::std::array<::std::array<::std::int32_t, 2>, 3> initial_demo_table{{{{1, 2}}, {}, {{5}}}};
inline constexpr ::demo::P initial_demo_p{1.0, -2.0};
inline constexpr ::std::array<::demo::P, 4> initial_demo_ps{{{1.0, {}}, {2.0, 3.0}}};
inline constexpr ::std::array<::indurop::string<8>, 3> initial_demo_names{{"one", {}, "three"}};
inline constexpr ::demo::nested_t initial_demo_nested{{1.0, 2.0}, {{3, 4}}, true};
inline constexpr ::std::int32_t initial_demo_braces{7};
inline constinit ::indurop::abi::Ref refs[] = {
    {0xaecab772fc402801, 0x2af2b3192b419145, nullptr, &initial_demo_a, 4, ::indurop::abi::Kind::Scalar, "demo::a"},
    {0xdd3ed0b9e177d9a8, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::zero"},
    {0x425fff4441f30899, 0x08b70a07b55bfd94, nullptr, &initial_demo_least8, 1, ::indurop::abi::Kind::Scalar, "demo::least8"},
    {0xbc4961fc10148ff9, 0x2ae1af192b331746, nullptr, &initial_demo_least64, 8, ::indurop::abi::Kind::Scalar, "demo::least64"},
    {0xe3ec561dae2498fb, 0x4d35d3193e8d66f2, nullptr, &initial_demo_most64, 8, ::indurop::abi::Kind::Scalar, "demo::most64"},
    {0xe86958976dedc383, 0x4d2bdf193e8526d1, nullptr, &initial_demo_hex, 4, ::indurop::abi::Kind::Scalar, "demo::hex"},
    {0xaecab872fc4029b4, 0xdd635018ff703544, nullptr, &initial_demo_f, 4, ::indurop::abi::Kind::Scalar, "demo::f"},
    {0xaecab972fc402b67, 0xdd635018ff703544, nullptr, &initial_demo_g, 4, ::indurop::abi::Kind::Scalar, "demo::g"},
    {0xaecaae72fc4018b6, 0xdd635018ff703544, nullptr, &initial_demo_h, 4, ::indurop::abi::Kind::Scalar, "demo::h"},
    {0xaecaba72fc402d1a, 0xdd744c18ff7ea1ab, nullptr, &initial_demo_d, 8, ::indurop::abi::Kind::Scalar, "demo::d"},
    {0xd57d0d192bf84d61, 0xdd744c18ff7ea1ab, nullptr, &initial_demo_whole, 8, ::indurop::abi::Kind::Scalar, "demo::whole"},
    {0x668ef29724662d45, 0xcd2fd49bc6b014bd, nullptr, &initial_demo_yes, 1, ::indurop::abi::Kind::Scalar, "demo::yes"},
    {0x42864662a0f05769, 0xcd2fd49bc6b014bd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::no"},
    {0xe9a67ab455632966, 0xf2a393910b5b3ebd, nullptr, &initial_demo_letter, 1, ::indurop::abi::Kind::Scalar, "demo::letter"},
    {0x466f002c22e55c31, 0x196ff26a059abe6c, nullptr, &initial_demo_text, 16, ::indurop::abi::Kind::Ring, "demo::text"},
    {0x261467b7064a2485, 0x8afe3cc691fb7eb2, nullptr, &initial_demo_sized, 7, ::indurop::abi::Kind::Ring, "demo::sized"},
    {0x1b442d12a01dad1c, 0xbb14d8295c4cb7a2, nullptr, &initial_demo_numbers, 12, ::indurop::abi::Kind::Ring, "demo::numbers"},
    {0x4cc604e0e8cd13ce, 0x701e6b4eab9fdd02, nullptr, &initial_demo_table, 24, ::indurop::abi::Kind::Ring, "demo::table"},
    {0xaecaa672fc400b1e, 0x4b12722cf7960421, nullptr, &initial_demo_p, 16, ::indurop::abi::Kind::Ring, "demo::p"},
    {0x42644262a0d36a37, 0x06528d202c3ab049, nullptr, &initial_demo_ps, 64, ::indurop::abi::Kind::Ring, "demo::ps"},
    {0x4642951e0fb70b96, 0x40b79b49851bf342, nullptr, &initial_demo_names, 24, ::indurop::abi::Kind::Ring, "demo::names"},
    {0x2c2081f64788d915, 0x773fc24a2009a688, nullptr, &initial_demo_nested, 32, ::indurop::abi::Kind::Ring, "demo::nested"},
    {0x17493ff1b9e696fa, 0x2af2b3192b419145, nullptr, &initial_demo_braces, 4, ::indurop::abi::Kind::Scalar, "demo::braces"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 23, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_demo_a {
  static constexpr ::std::uint64_t kNameHash = 0xaecab772fc402801;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_demo_zero {
  static constexpr ::std::uint64_t kNameHash = 0xdd3ed0b9e177d9a8;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_demo_least8 {
  static constexpr ::std::uint64_t kNameHash = 0x425fff4441f30899;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_demo_least64 {
  static constexpr ::std::uint64_t kNameHash = 0xbc4961fc10148ff9;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_demo_most64 {
  static constexpr ::std::uint64_t kNameHash = 0xe3ec561dae2498fb;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_demo_hex {
  static constexpr ::std::uint64_t kNameHash = 0xe86958976dedc383;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_demo_f {
  static constexpr ::std::uint64_t kNameHash = 0xaecab872fc4029b4;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_demo_g {
  static constexpr ::std::uint64_t kNameHash = 0xaecab972fc402b67;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
struct var_demo_h {
  static constexpr ::std::uint64_t kNameHash = 0xaecaae72fc4018b6;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[8]; }
};
struct var_demo_d {
  static constexpr ::std::uint64_t kNameHash = 0xaecaba72fc402d1a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[9]; }
};
struct var_demo_whole {
  static constexpr ::std::uint64_t kNameHash = 0xd57d0d192bf84d61;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[10]; }
};
struct var_demo_yes {
  static constexpr ::std::uint64_t kNameHash = 0x668ef29724662d45;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[11]; }
};
struct var_demo_no {
  static constexpr ::std::uint64_t kNameHash = 0x42864662a0f05769;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[12]; }
};
struct var_demo_letter {
  static constexpr ::std::uint64_t kNameHash = 0xe9a67ab455632966;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[13]; }
};
struct var_demo_text {
  static constexpr ::std::uint64_t kNameHash = 0x466f002c22e55c31;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[14]; }
};
struct var_demo_sized {
  static constexpr ::std::uint64_t kNameHash = 0x261467b7064a2485;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 7;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[15]; }
};
struct var_demo_numbers {
  static constexpr ::std::uint64_t kNameHash = 0x1b442d12a01dad1c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 12;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[16]; }
};
struct var_demo_table {
  static constexpr ::std::uint64_t kNameHash = 0x4cc604e0e8cd13ce;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 24;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[17]; }
};
struct var_demo_p {
  static constexpr ::std::uint64_t kNameHash = 0xaecaa672fc400b1e;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[18]; }
};
struct var_demo_ps {
  static constexpr ::std::uint64_t kNameHash = 0x42644262a0d36a37;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 64;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[19]; }
};
struct var_demo_names {
  static constexpr ::std::uint64_t kNameHash = 0x4642951e0fb70b96;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 24;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[20]; }
};
struct var_demo_nested {
  static constexpr ::std::uint64_t kNameHash = 0x2c2081f64788d915;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 32;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[21]; }
};
struct var_demo_braces {
  static constexpr ::std::uint64_t kNameHash = 0x17493ff1b9e696fa;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[22]; }
};
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
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_nested_t {
  using value_type = ::demo::nested_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop_generated_4e3c987a9dfecd45::ref_demo_P<indurop_tag, indurop_offset + 0> p;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 16>, 2> n;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 24> on;
  INDUROP_UNION_SHAPE(ref_demo_nested_t)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_4e3c987a9dfecd45

namespace demo {
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_a, ::std::int32_t, 0> a{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_zero, ::std::int32_t, 0> zero{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_least8, ::std::int8_t, 0> least8{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_least64, ::std::int64_t, 0> least64{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_most64, ::std::uint64_t, 0> most64{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_hex, ::std::uint32_t, 0> hex{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_f, float, 0> f{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_g, float, 0> g{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_h, float, 0> h{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_d, double, 0> d{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_whole, double, 0> whole{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_yes, bool, 0> yes{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_no, bool, 0> no{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_letter, char, 0> letter{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::Text<::indurop_generated_4e3c987a9dfecd45::var_demo_text, 16, 0> text{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::Text<::indurop_generated_4e3c987a9dfecd45::var_demo_sized, 7, 0> sized{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_4e3c987a9dfecd45::var_demo_numbers, ::std::int32_t, 0>, 3> numbers{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_4e3c987a9dfecd45::var_demo_table, ::std::int32_t, 0>, 2>, 3> table{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_4e3c987a9dfecd45::ref_demo_P<::indurop_generated_4e3c987a9dfecd45::var_demo_p, 0> p{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_4e3c987a9dfecd45::ref_demo_P<::indurop_generated_4e3c987a9dfecd45::var_demo_ps, 0>, 4> ps{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Text<::indurop_generated_4e3c987a9dfecd45::var_demo_names, 8, 0>, 3> names{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_4e3c987a9dfecd45::ref_demo_nested_t<::indurop_generated_4e3c987a9dfecd45::var_demo_nested, 0> nested{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_4e3c987a9dfecd45::var_demo_braces, ::std::int32_t, 0> braces{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace demo
