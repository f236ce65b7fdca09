// SPDX-License-Identifier: Apache-2.0
// What glb2idl writes for the variables and functions of these tests, by hand, so that libindurop is tested without
// the compiler. test_node.cpp has the same as a schema.

#pragma once

#include <indurop/function.h>
#include <indurop/lock.h>
#include <indurop/var.h>

namespace knu::Robot {

struct joints_t {
  double x{};
  double y{};
  double z{};
  friend bool operator==(const joints_t&, const joints_t&) = default;
};
template <class F>
constexpr void indurop_fields(const joints_t& v, F f) {
  f("x", v.x);
  f("y", v.y);
  f("z", v.z);
}
struct add_args {
  double a{};
  double b{};
};
struct count_args {};
struct nap_args {
  std::uint32_t ms{};
};

}  // namespace knu::Robot

namespace indurop_generated_sample __attribute__((visibility("hidden"))) {

constexpr std::uint64_t hash(std::string_view text) { return ::indurop::abi::fnv1a64(text.data(), text.size()); }

inline constexpr std::uint32_t tick_initial{7};
inline constinit ::indurop::abi::Ref refs[] = {
    {hash("knu::Robot::tick"), hash("u32"), nullptr, &tick_initial, 4, ::indurop::abi::Kind::Scalar, "knu::Robot::tick"},
    {hash("knu::Robot::joints"), hash("struct(24,8){x@0:f64,y@8:f64,z@16:f64}[10]"), nullptr, nullptr, 240,
     ::indurop::abi::Kind::Ring, "knu::Robot::joints"},
    {hash("knu::Robot::label"), hash("text(16)"), nullptr, nullptr, 16, ::indurop::abi::Kind::Ring, "knu::Robot::label"},
    {hash("knu::Robot::ready"), hash("bool"), nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "knu::Robot::ready"},
};

#define SAMPLE_TAG(tag, index, kind, size)                                     \
  struct tag {                                                                 \
    static constexpr std::uint64_t kNameHash = refs_name[index];               \
    static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::kind;  \
    static constexpr std::size_t kSize = size;                                 \
    INDUROP_ALWAYS_INLINE static const ::indurop::abi::Ref& ref() noexcept {   \
      return refs[index];                                                      \
    }                                                                          \
  }
inline constexpr std::uint64_t refs_name[] = {hash("knu::Robot::tick"), hash("knu::Robot::joints"),
                                              hash("knu::Robot::label"), hash("knu::Robot::ready")};
SAMPLE_TAG(tick_tag, 0, Scalar, 4);
SAMPLE_TAG(joints_tag, 1, Ring, 240);
SAMPLE_TAG(label_tag, 2, Ring, 16);
SAMPLE_TAG(ready_tag, 3, Scalar, 1);
#undef SAMPLE_TAG

template <class Tag, std::uint32_t Offset, class = ::indurop::Adl>
union joints_t_ref {
  using value_type = ::knu::Robot::joints_t;
  using whole_type = value_type;
  using tag_type = Tag;
  static constexpr std::uint32_t kOffset = Offset;
  ::indurop::Place place;
  ::indurop::Leaf<Tag, double, Offset + 0> x;
  ::indurop::Leaf<Tag, double, Offset + 8> y;
  ::indurop::Leaf<Tag, double, Offset + 16> z;
  INDUROP_STRUCT_SHAPE(joints_t_ref)
};

[[gnu::constructor(101)]] inline void bind() {
  indurop_register_refs(refs, sizeof refs / sizeof refs[0], ::indurop::abi::kVersion);
}
[[gnu::destructor(101)]] inline void unbind() { indurop_unregister_refs(refs); }

struct add_tag {
  using args = ::knu::Robot::add_args;
  using result = double;
  static constexpr const char* kName = "knu::Robot::add";
  static constexpr std::uint64_t kNameHash = hash("knu::Robot::add");
  static constexpr std::uint64_t kTypeHash = hash("struct(16,8){a@0:f64,b@8:f64}->f64");
  static constexpr std::int64_t kDeadlineNs = 2'000'000'000;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.a, a.b);
  }
};
struct count_tag {
  using args = ::knu::Robot::count_args;
  using result = void;
  static constexpr const char* kName = "knu::Robot::count";
  static constexpr std::uint64_t kNameHash = hash("knu::Robot::count");
  static constexpr std::uint64_t kTypeHash = hash("struct(1,1){}->void");
  static constexpr std::int64_t kDeadlineNs = 2'000'000'000;
  template <class F>
  static void apply(F&& f, const args& /*none*/) {
    f();
  }
};
struct nap_tag {
  using args = ::knu::Robot::nap_args;
  using result = std::uint32_t;
  static constexpr const char* kName = "knu::Robot::nap";
  static constexpr std::uint64_t kNameHash = hash("knu::Robot::nap");
  static constexpr std::uint64_t kTypeHash = hash("struct(4,4){ms@0:u32}->u32");
  static constexpr std::int64_t kDeadlineNs = 0;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.ms);
  }
};

}  // namespace indurop_generated_sample

namespace knu::Robot {
inline constexpr ::indurop::Leaf<::indurop_generated_sample::tick_tag, std::uint32_t, 0> tick{::indurop::Place{0},
                                                                                              ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<
    ::indurop_generated_sample::joints_t_ref<::indurop_generated_sample::joints_tag, 0>, 10>
    joints{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::Text<::indurop_generated_sample::label_tag, 16, 0> label{::indurop::Place{0},
                                                                                     ::indurop::detail::Make{}};
inline constexpr ::indurop::Leaf<::indurop_generated_sample::ready_tag, bool, 0> ready{::indurop::Place{0},
                                                                                       ::indurop::detail::Make{}};
inline constexpr ::indurop::Function<::indurop_generated_sample::add_tag, double(double, double)> add{};
inline constexpr ::indurop::Function<::indurop_generated_sample::count_tag, void()> count{};
inline constexpr ::indurop::Function<::indurop_generated_sample::nap_tag, std::uint32_t(std::uint32_t)> nap{};
}  // namespace knu::Robot
