// SPDX-License-Identifier: Apache-2.0
// Functions that the inline code of generated headers calls for its variables.

#include <indurop/detail/abi.h>
#include <indurop/detail/freshness.h>
#include <indurop/lock.h>
#include <indurop/plc/program.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "core/base/exit_code.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"
#include "store/runtime/ref_tables.h"
#include "store/vars/forces.h"
#include "store/vars/tear_free_ring.h"
#include "store/vars/together.h"

extern "C" {

void indurop_register_refs(indurop::abi::Ref* refs, std::uint32_t count, std::uint32_t abi_version) {
  if (abi_version != indurop::abi::kVersion) {
    // The rows have another layout, so the variables cannot even be bound to private memory.
    std::fprintf(
        stderr,
        "indurop: this program was built for version %u of the variables' layout, libindurop.so has %u: rebuild it\n",
        abi_version, indurop::abi::kVersion);
    std::_Exit(indurop::kSchemaMismatch);
  }
  indurop::runtime::Process::get().register_refs(refs, count);
}

void indurop_unregister_refs(indurop::abi::Ref* refs) {
  indurop::runtime::Process::get().unregister_refs(refs);
}

std::uint32_t indurop_bindings() noexcept {
  return indurop::runtime::RefTables::bindings();
}

void* indurop_begin_write(indurop::abi::RingHeader* ring, std::uint32_t offset, std::uint32_t length) noexcept {
  return indurop::vars::begin_write(*ring, offset, length);
}
void* indurop_begin_edit(indurop::abi::RingHeader* ring) noexcept {
  return indurop::vars::begin_edit(*ring);
}
void indurop_commit_write(indurop::abi::RingHeader* ring) noexcept {
  indurop::vars::commit(*ring);
}
void indurop_abort_write(indurop::abi::RingHeader* ring) noexcept {
  indurop::vars::discard(*ring);
}

std::int64_t indurop_see_confirmed(std::int64_t confirmed) noexcept {
  return indurop::runtime::see_confirmed(confirmed);
}

bool indurop_hold_scalar(void* entry) noexcept {
  return indurop::vars::hold_scalar(entry);
}

void indurop_read_slow(const indurop::abi::RingHeader* ring, void* to, std::uint32_t offset,
                       std::uint32_t length) noexcept {
  auto& writable = const_cast<indurop::abi::RingHeader&>(*ring);  // NOLINT(*-const-cast): mapped writable
  indurop::vars::read_slow(writable, to, offset, length);
}

bool indurop_read_together(indurop::abi::Piece* pieces, std::uint32_t count) noexcept {
  return indurop::runtime::answer([=]() -> std::int64_t {
           return indurop::vars::read_together({pieces, count}) ? 1 : 0;
         }) != 0;
}

void indurop_index_fault(const char* variable, std::uint64_t index, std::uint64_t bound) {
  throw std::out_of_range(std::string(variable) + ": index " + std::to_string(index) + " is beyond its " +
                          std::to_string(bound) + " elements");
}

void indurop_lock_fault(const char* variable) {
  throw std::runtime_error(std::string(variable) +
                           ": not locked: its lock was not free within 5 ms, or this thread holds it already");
}
}
