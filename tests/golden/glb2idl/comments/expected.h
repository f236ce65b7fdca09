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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_26150496fa69e099,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"above\",\"type\":\"int32\",\"kind\":\"scalar\",\"description\":\"A des"
.ascii "cription needs no marks: stars and blanks are cut.\",\"source\":\"in.glb:2\"},{\"name\":\"behind\",\"type\":\"in"
.ascii "t32\",\"kind\":\"scalar\",\"description\":\"behind wins over above\",\"source\":\"in.glb:3\"},{\"name\":\"none\",\"typ"
.ascii "e\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:6\"},{\"name\":\"two\",\"type\":\"int32\",\"kind\":\"scalar\",\"descri"
.ascii "ption\":\"two lines of text\",\"source\":\"in.glb:9\"},{\"name\":\"one\",\"type\":\"int32\",\"kind\":\"scalar\",\"descri"
.ascii "ption\":\"for both\",\"source\":\"in.glb:10\"},{\"name\":\"both\",\"type\":\"int32\",\"kind\":\"scalar\",\"description\":"
.ascii "\"for both\",\"source\":\"in.glb:10\"},{\"name\":\"a\",\"type\":\"int32\",\"kind\":\"scalar\",\"source\":\"in.glb:11\"},{\""
.ascii "name\":\"b\",\"type\":\"int32\",\"kind\":\"scalar\",\"description\":\"only b\",\"source\":\"in.glb:11\"},{\"name\":\"ruler"
.ascii "\",\"type\":\"int32\",\"kind\":\"scalar\",\"description\":\"banner\",\"source\":\"in.glb:15\"},{\"name\":\"s\",\"type\":{\"b"
.ascii "ase\":\"struct\",\"name\":\"S\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"x\",\"type\":\"int32\",\"offset\":0,\"descrip"
.ascii "tion\":\"field above\"},{\"name\":\"y\",\"type\":\"int32\",\"offset\":4,\"description\":\"doxygen style\"}]},\"kind\":\""
.ascii "ring\",\"source\":\"in.glb:21\"},{\"name\":\"in\",\"type\":\"int32\",\"kind\":\"scalar\",\"initial\":\"04000000\",\"source"
.ascii "\":\"in.glb:22\"}]}"
.ascii "\n"
.popsection)indurop");
struct S {  // the struct
  ::std::int32_t x{};  // field above
  ::std::int32_t y{};  // doxygen style
  friend bool operator==(const S&, const S&) = default;
};
static_assert(sizeof(S) == 8 && alignof(S) == 4);
static_assert(offsetof(S, x) == 0);
static_assert(offsetof(S, y) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const S& v, indurop_visitor f) {
  f("x", v.x);
  f("y", v.y);
}

namespace indurop_generated_26150496fa69e099 __attribute__((visibility("hidden"))) {
inline constexpr ::std::int32_t initial_in{4};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x3f71052d617f9b2a, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "above"},
    {0xfd7bbb6eebc12569, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "behind"},
    {0x3c0d17bad169557b, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "none"},
    {0x5714d319447c9709, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "two"},
    {0x1a08aa1921ca5caf, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "one"},
    {0xcd17f69bc69bbca2, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "both"},
    {0xaf63dc4c8601ec8c, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "a"},
    {0xaf63df4c8601f1a5, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "b"},
    {0x6712506a28515573, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "ruler"},
    {0xaf63ee4c86020b22, 0x5cd3fbf055221f86, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "s"},
    {0x08b73807b55c4bbe, 0x2af2b3192b419145, nullptr, &initial_in, 4, ::indurop::abi::Kind::Scalar, "in"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 11, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_above {
  static constexpr ::std::uint64_t kNameHash = 0x3f71052d617f9b2a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_behind {
  static constexpr ::std::uint64_t kNameHash = 0xfd7bbb6eebc12569;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_none {
  static constexpr ::std::uint64_t kNameHash = 0x3c0d17bad169557b;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_two {
  static constexpr ::std::uint64_t kNameHash = 0x5714d319447c9709;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_one {
  static constexpr ::std::uint64_t kNameHash = 0x1a08aa1921ca5caf;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_both {
  static constexpr ::std::uint64_t kNameHash = 0xcd17f69bc69bbca2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_a {
  static constexpr ::std::uint64_t kNameHash = 0xaf63dc4c8601ec8c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_b {
  static constexpr ::std::uint64_t kNameHash = 0xaf63df4c8601f1a5;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
struct var_ruler {
  static constexpr ::std::uint64_t kNameHash = 0x6712506a28515573;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[8]; }
};
struct var_s {
  static constexpr ::std::uint64_t kNameHash = 0xaf63ee4c86020b22;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[9]; }
};
struct var_in {
  static constexpr ::std::uint64_t kNameHash = 0x08b73807b55c4bbe;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[10]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_S {
  using value_type = ::S;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 4> y;
  INDUROP_UNION_SHAPE(ref_S)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_26150496fa69e099
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_above, ::std::int32_t, 0> above{::indurop::Place{0}, ::indurop::detail::Make{}};  // A description needs no marks: stars and blanks are cut.
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_behind, ::std::int32_t, 0> behind{::indurop::Place{0}, ::indurop::detail::Make{}};  // behind wins over above
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_none, ::std::int32_t, 0> none{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_two, ::std::int32_t, 0> two{::indurop::Place{0}, ::indurop::detail::Make{}};  // two lines of text
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_one, ::std::int32_t, 0> one{::indurop::Place{0}, ::indurop::detail::Make{}};  // for both
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_both, ::std::int32_t, 0> both{::indurop::Place{0}, ::indurop::detail::Make{}};  // for both
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_a, ::std::int32_t, 0> a{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_b, ::std::int32_t, 0> b{::indurop::Place{0}, ::indurop::detail::Make{}};  // only b
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_ruler, ::std::int32_t, 0> ruler{::indurop::Place{0}, ::indurop::detail::Make{}};  // banner
inline constexpr ::indurop_generated_26150496fa69e099::ref_S<::indurop_generated_26150496fa69e099::var_s, 0> s{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_26150496fa69e099::var_in, ::std::int32_t, 0> in{::indurop::Place{0}, ::indurop::detail::Make{}};
