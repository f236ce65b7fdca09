// SPDX-License-Identifier: Apache-2.0
// The functions of <indurop/module_c.h>, which cannot be included here because it is C: variables, life of a process,
// schedule, properties.

#include <indurop/detail/freshness.h>
#include <indurop/detail/variable_access.h>
#include <indurop/irp.h>

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>

#include "store/vars/scalar.h"
#include "store/vars/tear_free_ring.h"

namespace {

using indurop::abi::Kind;
using indurop::abi::Ref;
using indurop::abi::RingHeader;

void* entry_of(const Ref& ref, std::size_t offset, std::size_t size) {
  if (offset > ref.value_size || size > ref.value_size - offset) {
    throw std::out_of_range(fmt::format("{}: {} bytes at {} are beyond its {}: an index is too large", ref.name, size,
                                        static_cast<std::ptrdiff_t>(offset), ref.value_size));
  }
  return ref.entry;
}

std::int64_t confirmed_of(const Ref& ref) noexcept {
  return indurop_see_confirmed(indurop::abi::confirmed_of(ref.entry, ref.kind).load(std::memory_order_acquire));
}

}  // namespace

extern "C" {

void indurop_c_get(const Ref* ref, std::size_t offset, void* to, std::size_t size) {
  void* const entry = entry_of(*ref, offset, size);
  const auto at = static_cast<std::uint32_t>(offset);
  if (ref->kind == Kind::Scalar) {
    indurop::vars::read_scalar(static_cast<const std::byte*>(entry), ref->value_size, at,
                               {static_cast<std::uint8_t*>(to), size});
    return;
  }
  auto* const ring = static_cast<RingHeader*>(entry);
  const auto length = static_cast<std::uint32_t>(size);
  if (!indurop::vars::try_read(*ring, ref->value_size, at, to, length)) {
    indurop::vars::read_slow(*ring, to, at, length);
  }
}

void indurop_c_set(const Ref* ref, std::size_t offset, const void* from, std::size_t size) {
  void* const entry = entry_of(*ref, offset, size);
  const auto at = static_cast<std::uint32_t>(offset);
  if (ref->kind == Kind::Scalar) {
    indurop::vars::write_scalar(static_cast<std::byte*>(entry), ref->value_size, at,
                                {static_cast<const std::uint8_t*>(from), size});
    return;
  }
  auto& ring = *static_cast<RingHeader*>(entry);
  if (void* const to = indurop::vars::begin_write(ring, at, static_cast<std::uint32_t>(size)); to != nullptr) {
    indurop::detail::copy_to_shared(static_cast<unsigned char*>(to) + at, from, size);
    indurop::vars::commit(ring);
  }
}

std::int64_t indurop_c_age_ns(const Ref* ref) noexcept {
  return indurop::detail::age_of(confirmed_of(*ref), irp::now_ns).count();
}

bool indurop_c_is_valid(const Ref* ref, std::int64_t max_age_ns) noexcept {
  return indurop::detail::is_valid(confirmed_of(*ref), max_age_ns, irp::now_ns);
}

// NOLINTBEGIN(readability-identifier-naming): the names of C
int irp_initPeriodExe() {
  return irp::initPeriodExe();
}
bool irp_waitPeriod() {
  return irp::waitPeriod();
}
// NOLINTEND(readability-identifier-naming)

std::int64_t irp_period_ns() noexcept {
  return irp::period().count();
}
std::uint64_t irp_tick() noexcept {
  return irp::tick();
}
std::int64_t irp_release_ns() noexcept {
  return irp::release_ns();
}
std::int64_t irp_now_ns() noexcept {
  return irp::now_ns();
}
bool irp_stop_requested() noexcept {
  return irp::stop_requested();
}

std::int64_t irp_property_integer(const char* name, std::int64_t fallback) {
  irp::detail::property_signed(name, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(),
                               fallback);
  return fallback;
}
double irp_property_real(const char* name, double fallback) {
  irp::detail::property_real(name, fallback);
  return fallback;
}
bool irp_property_bool(const char* name, bool fallback) {
  irp::detail::property_bool(name, fallback);
  return fallback;
}
const char* irp_property_text(const char* name, const char* fallback) {
  const char* const text = irp::detail::property_text(name);
  return text != nullptr ? text : fallback;
}
}
