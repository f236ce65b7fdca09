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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_52243594835acbe9,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"demo::types::a1\",\"type\":\"int8\",\"kind\":\"scalar\",\"source\":\"i"
.ascii "n.glb:2\"},{\"name\":\"demo::types::a2\",\"type\":\"uint8\",\"kind\":\"scalar\",\"source\":\"in.glb:2\"},{\"name\":\"dem"
.ascii "o::types::a3\",\"type\":\"int16\",\"kind\":\"scalar\",\"source\":\"in.glb:2\"},{\"name\":\"demo::types::a4\",\"type\":\""
.ascii "uint16\",\"kind\":\"scalar\",\"source\":\"in.glb:2\"},{\"name\":\"demo::types::a5\",\"type\":\"int32\",\"kind\":\"scalar"
.ascii "\",\"source\":\"in.glb:2\"},{\"name\":\"demo::types::a6\",\"type\":\"uint32\",\"kind\":\"scalar\",\"source\":\"in.glb:2\""
.ascii "},{\"name\":\"demo::types::a7\",\"type\":\"int64\",\"kind\":\"scalar\",\"source\":\"in.glb:2\"},{\"name\":\"demo::types"
.ascii "::a8\",\"type\":\"uint64\",\"kind\":\"scalar\",\"source\":\"in.glb:2\"},{\"name\":\"demo::types::b1\",\"type\":\"int8\",\""
.ascii "kind\":\"scalar\",\"source\":\"in.glb:3\"},{\"name\":\"demo::types::b2\",\"type\":\"uint8\",\"kind\":\"scalar\",\"source"
.ascii "\":\"in.glb:3\"},{\"name\":\"demo::types::b3\",\"type\":\"int16\",\"kind\":\"scalar\",\"source\":\"in.glb:3\"},{\"name\":"
.ascii "\"demo::types::b4\",\"type\":\"uint16\",\"kind\":\"scalar\",\"source\":\"in.glb:3\"},{\"name\":\"demo::types::b5\",\"ty"
.ascii "pe\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:3\"},{\"name\":\"demo::types::b6\",\"type\":\"uint32\",\"kind\":\"s"
.ascii "calar\",\"source\":\"in.glb:3\"},{\"name\":\"demo::types::b7\",\"type\":\"int64\",\"kind\":\"scalar\",\"source\":\"in.gl"
.ascii "b:3\"},{\"name\":\"demo::types::b8\",\"type\":\"uint64\",\"kind\":\"scalar\",\"source\":\"in.glb:3\"},{\"name\":\"demo::"
.ascii "types::c1\",\"type\":\"char\",\"kind\":\"scalar\",\"source\":\"in.glb:4\"},{\"name\":\"demo::types::c2\",\"type\":\"int8"
.ascii "\",\"kind\":\"scalar\",\"source\":\"in.glb:4\"},{\"name\":\"demo::types::c3\",\"type\":\"uint8\",\"kind\":\"scalar\",\"sou"
.ascii "rce\":\"in.glb:4\"},{\"name\":\"demo::types::c4\",\"type\":\"uint8\",\"kind\":\"scalar\",\"source\":\"in.glb:4\"},{\"nam"
.ascii "e\":\"demo::types::d1\",\"type\":\"int16\",\"kind\":\"scalar\",\"source\":\"in.glb:5\"},{\"name\":\"demo::types::d2\",\""
.ascii "type\":\"int16\",\"kind\":\"scalar\",\"source\":\"in.glb:5\"},{\"name\":\"demo::types::d3\",\"type\":\"uint16\",\"kind\":"
.ascii "\"scalar\",\"source\":\"in.glb:5\"},{\"name\":\"demo::types::d4\",\"type\":\"int16\",\"kind\":\"scalar\",\"source\":\"in."
.ascii "glb:5\"},{\"name\":\"demo::types::e1\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:6\"},{\"name\":\"demo:"
.ascii ":types::e2\",\"type\":\"uint32\",\"kind\":\"scalar\",\"source\":\"in.glb:6\"},{\"name\":\"demo::types::e3\",\"type\":\"i"
.ascii "nt32\",\"kind\":\"scalar\",\"source\":\"in.glb:6\"},{\"name\":\"demo::types::e4\",\"type\":\"uint32\",\"kind\":\"scalar\""
.ascii ",\"source\":\"in.glb:6\"},{\"name\":\"demo::types::f1\",\"type\":\"int64\",\"kind\":\"scalar\",\"source\":\"in.glb:7\"},"
.ascii "{\"name\":\"demo::types::f2\",\"type\":\"uint64\",\"kind\":\"scalar\",\"source\":\"in.glb:7\"},{\"name\":\"demo::types:"
.ascii ":f3\",\"type\":\"int64\",\"kind\":\"scalar\",\"source\":\"in.glb:7\"},{\"name\":\"demo::types::f4\",\"type\":\"uint64\",\""
.ascii "kind\":\"scalar\",\"source\":\"in.glb:7\"},{\"name\":\"demo::types::g1\",\"type\":\"int64\",\"kind\":\"scalar\",\"source"
.ascii "\":\"in.glb:8\"},{\"name\":\"demo::types::g2\",\"type\":\"uint64\",\"kind\":\"scalar\",\"source\":\"in.glb:8\"},{\"name\""
.ascii ":\"demo::types::g3\",\"type\":\"uint64\",\"kind\":\"scalar\",\"source\":\"in.glb:8\"},{\"name\":\"demo::types::h1\",\"t"
.ascii "ype\":\"float\",\"kind\":\"scalar\",\"source\":\"in.glb:9\"},{\"name\":\"demo::types::h2\",\"type\":\"double\",\"kind\":\""
.ascii "scalar\",\"source\":\"in.glb:9\"},{\"name\":\"demo::types::h3\",\"type\":\"bool\",\"kind\":\"scalar\",\"source\":\"in.gl"
.ascii "b:9\"},{\"name\":\"demo::types::text\",\"type\":{\"base\":\"text\",\"size\":16},\"kind\":\"ring\",\"source\":\"in.glb:10"
.ascii "\"},{\"name\":\"demo::types::texts\",\"type\":{\"base\":\"text\",\"size\":8,\"dims\":[2,3]},\"kind\":\"ring\",\"source\":"
.ascii "\"in.glb:10\"},{\"name\":\"demo::types::matrix\",\"type\":{\"base\":\"double\",\"dims\":[4,4]},\"kind\":\"ring\",\"sour"
.ascii "ce\":\"in.glb:11\"},{\"name\":\"demo::types::flags\",\"type\":{\"base\":\"bool\",\"dims\":[3]},\"kind\":\"ring\",\"sourc"
.ascii "e\":\"in.glb:11\"},{\"name\":\"demo::types::mixed\",\"type\":{\"base\":\"struct\",\"name\":\"demo::types::Mixed\",\"si"
.ascii "ze\":48,\"align\":8,\"fields\":[{\"name\":\"flag\",\"type\":\"bool\",\"offset\":0},{\"name\":\"number\",\"type\":\"double\""
.ascii ",\"offset\":8},{\"name\":\"letter\",\"type\":\"char\",\"offset\":16},{\"name\":\"word\",\"type\":\"int16\",\"offset\":18},"
.ascii "{\"name\":\"name\",\"type\":{\"base\":\"text\",\"size\":5},\"offset\":20},{\"name\":\"big\",\"type\":\"int64\",\"offset\":32"
.ascii "},{\"name\":\"last\",\"type\":\"uint8\",\"offset\":40}]},\"kind\":\"ring\",\"source\":\"in.glb:20\"},{\"name\":\"demo::ty"
.ascii "pes::mixes\",\"type\":{\"base\":\"struct\",\"name\":\"demo::types::Mixed\",\"size\":48,\"align\":8,\"fields\":[{\"name"
.ascii "\":\"flag\",\"type\":\"bool\",\"offset\":0},{\"name\":\"number\",\"type\":\"double\",\"offset\":8},{\"name\":\"letter\",\"ty"
.ascii "pe\":\"char\",\"offset\":16},{\"name\":\"word\",\"type\":\"int16\",\"offset\":18},{\"name\":\"name\",\"type\":{\"base\":\"te"
.ascii "xt\",\"size\":5},\"offset\":20},{\"name\":\"big\",\"type\":\"int64\",\"offset\":32},{\"name\":\"last\",\"type\":\"uint8\",\""
.ascii "offset\":40}],\"dims\":[2,2]},\"kind\":\"ring\",\"source\":\"in.glb:20\"}]}"
.ascii "\n"
.popsection)indurop");

namespace demo::types {
struct Mixed {
  bool flag{};
  double number{};
  char letter{};
  ::std::int16_t word{};
  ::indurop::string<5> name{};
  ::std::int64_t big{};
  ::std::uint8_t last{};
  friend bool operator==(const Mixed&, const Mixed&) = default;
};
static_assert(sizeof(Mixed) == 48 && alignof(Mixed) == 8);
static_assert(offsetof(Mixed, flag) == 0);
static_assert(offsetof(Mixed, number) == 8);
static_assert(offsetof(Mixed, letter) == 16);
static_assert(offsetof(Mixed, word) == 18);
static_assert(offsetof(Mixed, name) == 20);
static_assert(offsetof(Mixed, big) == 32);
static_assert(offsetof(Mixed, last) == 40);
template <class indurop_visitor>
constexpr void indurop_fields(const Mixed& v, indurop_visitor f) {
  f("flag", v.flag);
  f("number", v.number);
  f("letter", v.letter);
  f("word", v.word);
  f("name", v.name);
  f("big", v.big);
  f("last", v.last);
}
}  // namespace demo::types

namespace indurop_generated_52243594835acbe9 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0x76bb90032f9411ed, 0x08b70a07b55bfd94, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::a1"},
    {0x76bb8d032f940cd4, 0x08c48207b56753d8, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::a2"},
    {0x76bb8e032f940e87, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::a3"},
    {0x76bb8b032f94096e, 0x4d24d3193e7ef3bf, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::a4"},
    {0x76bb8c032f940b21, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::a5"},
    {0x76bb89032f940608, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::a6"},
    {0x76bb8a032f9407bb, 0x2ae1af192b331746, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::a7"},
    {0x76bb87032f9402a2, 0x4d35d3193e8d66f2, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::a8"},
    {0x76b808032f90f4fe, 0x08b70a07b55bfd94, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::b1"},
    {0x76b807032f90f34b, 0x08c48207b56753d8, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::b2"},
    {0x76b806032f90f198, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::b3"},
    {0x76b80d032f90fd7d, 0x4d24d3193e7ef3bf, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::b4"},
    {0x76b80c032f90fbca, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::b5"},
    {0x76b80b032f90fa17, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::b6"},
    {0x76b80a032f90f864, 0x2ae1af192b331746, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::b7"},
    {0x76b801032f90e919, 0x4d35d3193e8d66f2, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::b8"},
    {0x76b504032f8eb85b, 0xf2a393910b5b3ebd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::c1"},
    {0x76b505032f8eba0e, 0x08b70a07b55bfd94, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::c2"},
    {0x76b506032f8ebbc1, 0x08c48207b56753d8, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::c3"},
    {0x76b507032f8ebd74, 0x08c48207b56753d8, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::c4"},
    {0x76cc8c032fa27e54, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::d1"},
    {0x76cc8f032fa2836d, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::d2"},
    {0x76cc8e032fa281ba, 0x4d24d3193e7ef3bf, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::d3"},
    {0x76cc89032fa2793b, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "demo::types::d4"},
    {0x76c908032f9f6831, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::e1"},
    {0x76c905032f9f6318, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::e2"},
    {0x76c906032f9f64cb, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::e3"},
    {0x76c90b032f9f6d4a, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::e4"},
    {0x76c600032f9d24c2, 0x2ae1af192b331746, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::f1"},
    {0x76c5ff032f9d230f, 0x4d35d3193e8d66f2, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::f2"},
    {0x76c5fe032f9d215c, 0x2ae1af192b331746, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::f3"},
    {0x76c5fd032f9d1fa9, 0x4d35d3193e8d66f2, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::f4"},
    {0x76c27c032f9a0e9f, 0x2ae1af192b331746, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::g1"},
    {0x76c27d032f9a1052, 0x4d35d3193e8d66f2, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::g2"},
    {0x76c27e032f9a1205, 0x4d35d3193e8d66f2, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::g3"},
    {0x76a404032f804528, 0xdd635018ff703544, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::types::h1"},
    {0x76a407032f804a41, 0xdd744c18ff7ea1ab, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::types::h2"},
    {0x76a406032f80488e, 0xcd2fd49bc6b014bd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::types::h3"},
    {0x3718be802962b1ac, 0x196ff26a059abe6c, nullptr, nullptr, 16, ::indurop::abi::Kind::Ring, "demo::types::text"},
    {0x01bd92c652b43ded, 0x3309423a66f33ff0, nullptr, nullptr, 48, ::indurop::abi::Kind::Ring, "demo::types::texts"},
    {0x203edd8ec97a95ae, 0x358bc79390d2406b, nullptr, nullptr, 128, ::indurop::abi::Kind::Ring, "demo::types::matrix"},
    {0xb109aa7723dfc1f2, 0x61a3d366e00f03ca, nullptr, nullptr, 3, ::indurop::abi::Kind::Ring, "demo::types::flags"},
    {0x10ba2c607a7cc18a, 0xa56b0cb35ff5ec6f, nullptr, nullptr, 48, ::indurop::abi::Kind::Ring, "demo::types::mixed"},
    {0x10ba37607a7cd43b, 0x283e3bd259bac8af, nullptr, nullptr, 192, ::indurop::abi::Kind::Ring, "demo::types::mixes"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 44, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_demo_types_a1 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb90032f9411ed;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_demo_types_a2 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb8d032f940cd4;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_demo_types_a3 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb8e032f940e87;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_demo_types_a4 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb8b032f94096e;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_demo_types_a5 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb8c032f940b21;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_demo_types_a6 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb89032f940608;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_demo_types_a7 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb8a032f9407bb;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_demo_types_a8 {
  static constexpr ::std::uint64_t kNameHash = 0x76bb87032f9402a2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
struct var_demo_types_b1 {
  static constexpr ::std::uint64_t kNameHash = 0x76b808032f90f4fe;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[8]; }
};
struct var_demo_types_b2 {
  static constexpr ::std::uint64_t kNameHash = 0x76b807032f90f34b;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[9]; }
};
struct var_demo_types_b3 {
  static constexpr ::std::uint64_t kNameHash = 0x76b806032f90f198;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[10]; }
};
struct var_demo_types_b4 {
  static constexpr ::std::uint64_t kNameHash = 0x76b80d032f90fd7d;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[11]; }
};
struct var_demo_types_b5 {
  static constexpr ::std::uint64_t kNameHash = 0x76b80c032f90fbca;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[12]; }
};
struct var_demo_types_b6 {
  static constexpr ::std::uint64_t kNameHash = 0x76b80b032f90fa17;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[13]; }
};
struct var_demo_types_b7 {
  static constexpr ::std::uint64_t kNameHash = 0x76b80a032f90f864;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[14]; }
};
struct var_demo_types_b8 {
  static constexpr ::std::uint64_t kNameHash = 0x76b801032f90e919;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[15]; }
};
struct var_demo_types_c1 {
  static constexpr ::std::uint64_t kNameHash = 0x76b504032f8eb85b;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[16]; }
};
struct var_demo_types_c2 {
  static constexpr ::std::uint64_t kNameHash = 0x76b505032f8eba0e;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[17]; }
};
struct var_demo_types_c3 {
  static constexpr ::std::uint64_t kNameHash = 0x76b506032f8ebbc1;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[18]; }
};
struct var_demo_types_c4 {
  static constexpr ::std::uint64_t kNameHash = 0x76b507032f8ebd74;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[19]; }
};
struct var_demo_types_d1 {
  static constexpr ::std::uint64_t kNameHash = 0x76cc8c032fa27e54;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[20]; }
};
struct var_demo_types_d2 {
  static constexpr ::std::uint64_t kNameHash = 0x76cc8f032fa2836d;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[21]; }
};
struct var_demo_types_d3 {
  static constexpr ::std::uint64_t kNameHash = 0x76cc8e032fa281ba;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[22]; }
};
struct var_demo_types_d4 {
  static constexpr ::std::uint64_t kNameHash = 0x76cc89032fa2793b;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[23]; }
};
struct var_demo_types_e1 {
  static constexpr ::std::uint64_t kNameHash = 0x76c908032f9f6831;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[24]; }
};
struct var_demo_types_e2 {
  static constexpr ::std::uint64_t kNameHash = 0x76c905032f9f6318;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[25]; }
};
struct var_demo_types_e3 {
  static constexpr ::std::uint64_t kNameHash = 0x76c906032f9f64cb;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[26]; }
};
struct var_demo_types_e4 {
  static constexpr ::std::uint64_t kNameHash = 0x76c90b032f9f6d4a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[27]; }
};
struct var_demo_types_f1 {
  static constexpr ::std::uint64_t kNameHash = 0x76c600032f9d24c2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[28]; }
};
struct var_demo_types_f2 {
  static constexpr ::std::uint64_t kNameHash = 0x76c5ff032f9d230f;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[29]; }
};
struct var_demo_types_f3 {
  static constexpr ::std::uint64_t kNameHash = 0x76c5fe032f9d215c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[30]; }
};
struct var_demo_types_f4 {
  static constexpr ::std::uint64_t kNameHash = 0x76c5fd032f9d1fa9;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[31]; }
};
struct var_demo_types_g1 {
  static constexpr ::std::uint64_t kNameHash = 0x76c27c032f9a0e9f;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[32]; }
};
struct var_demo_types_g2 {
  static constexpr ::std::uint64_t kNameHash = 0x76c27d032f9a1052;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[33]; }
};
struct var_demo_types_g3 {
  static constexpr ::std::uint64_t kNameHash = 0x76c27e032f9a1205;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[34]; }
};
struct var_demo_types_h1 {
  static constexpr ::std::uint64_t kNameHash = 0x76a404032f804528;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[35]; }
};
struct var_demo_types_h2 {
  static constexpr ::std::uint64_t kNameHash = 0x76a407032f804a41;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[36]; }
};
struct var_demo_types_h3 {
  static constexpr ::std::uint64_t kNameHash = 0x76a406032f80488e;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[37]; }
};
struct var_demo_types_text {
  static constexpr ::std::uint64_t kNameHash = 0x3718be802962b1ac;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[38]; }
};
struct var_demo_types_texts {
  static constexpr ::std::uint64_t kNameHash = 0x01bd92c652b43ded;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 48;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[39]; }
};
struct var_demo_types_matrix {
  static constexpr ::std::uint64_t kNameHash = 0x203edd8ec97a95ae;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 128;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[40]; }
};
struct var_demo_types_flags {
  static constexpr ::std::uint64_t kNameHash = 0xb109aa7723dfc1f2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 3;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[41]; }
};
struct var_demo_types_mixed {
  static constexpr ::std::uint64_t kNameHash = 0x10ba2c607a7cc18a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 48;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[42]; }
};
struct var_demo_types_mixes {
  static constexpr ::std::uint64_t kNameHash = 0x10ba37607a7cd43b;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 192;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[43]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_types_Mixed {
  using value_type = ::demo::types::Mixed;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 0> flag;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 8> number;
  ::indurop::Leaf<indurop_tag, char, indurop_offset + 16> letter;
  ::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 18> word;
  ::indurop::Text<indurop_tag, 5, indurop_offset + 20> name;
  ::indurop::Leaf<indurop_tag, ::std::int64_t, indurop_offset + 32> big;
  ::indurop::Leaf<indurop_tag, ::std::uint8_t, indurop_offset + 40> last;
  INDUROP_UNION_SHAPE(ref_demo_types_Mixed)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_52243594835acbe9

namespace demo::types {
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a1, ::std::int8_t, 0> a1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a2, ::std::uint8_t, 0> a2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a3, ::std::int16_t, 0> a3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a4, ::std::uint16_t, 0> a4{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a5, ::std::int32_t, 0> a5{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a6, ::std::uint32_t, 0> a6{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a7, ::std::int64_t, 0> a7{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_a8, ::std::uint64_t, 0> a8{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b1, ::std::int8_t, 0> b1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b2, ::std::uint8_t, 0> b2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b3, ::std::int16_t, 0> b3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b4, ::std::uint16_t, 0> b4{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b5, ::std::int32_t, 0> b5{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b6, ::std::uint32_t, 0> b6{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b7, ::std::int64_t, 0> b7{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_b8, ::std::uint64_t, 0> b8{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_c1, char, 0> c1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_c2, ::std::int8_t, 0> c2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_c3, ::std::uint8_t, 0> c3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_c4, ::std::uint8_t, 0> c4{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_d1, ::std::int16_t, 0> d1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_d2, ::std::int16_t, 0> d2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_d3, ::std::uint16_t, 0> d3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_d4, ::std::int16_t, 0> d4{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_e1, ::std::int32_t, 0> e1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_e2, ::std::uint32_t, 0> e2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_e3, ::std::int32_t, 0> e3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_e4, ::std::uint32_t, 0> e4{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_f1, ::std::int64_t, 0> f1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_f2, ::std::uint64_t, 0> f2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_f3, ::std::int64_t, 0> f3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_f4, ::std::uint64_t, 0> f4{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_g1, ::std::int64_t, 0> g1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_g2, ::std::uint64_t, 0> g2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_g3, ::std::uint64_t, 0> g3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_h1, float, 0> h1{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_h2, double, 0> h2{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52243594835acbe9::var_demo_types_h3, bool, 0> h3{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::Text<::indurop_generated_52243594835acbe9::var_demo_types_text, 16, 0> text{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Text<::indurop_generated_52243594835acbe9::var_demo_types_texts, 8, 0>, 3>, 2> texts{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_52243594835acbe9::var_demo_types_matrix, double, 0>, 4>, 4> matrix{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_52243594835acbe9::var_demo_types_flags, bool, 0>, 3> flags{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_52243594835acbe9::ref_demo_types_Mixed<::indurop_generated_52243594835acbe9::var_demo_types_mixed, 0> mixed{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop_generated_52243594835acbe9::ref_demo_types_Mixed<::indurop_generated_52243594835acbe9::var_demo_types_mixes, 0>, 2>, 2> mixes{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace demo::types
