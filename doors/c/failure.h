// SPDX-License-Identifier: Apache-2.0
// Errors of the C interface: a code, and the text that irp_error() returns in the same thread. No exception leaves the
// library.

#pragma once

#include <indurop/c.h>
#include <indurop/result.h>

#include <exception>
#include <new>
#include <string>

#include "store/operate/refusal.h"

namespace indurop::c {

struct Failure {
  irp_code code = IRP_SYSTEM;
  std::string text;
};

// The code of an error of the store; `about`: the node or variable.
Failure failure_of(const Error& error, const std::string& about);
Failure failure_of(const operate::Refusal& refusal);

// Keeps the text for irp_error(); returns the code.
irp_code fail(const Failure& failure) noexcept;
irp_code fail_in_system(const char* text) noexcept;

// Calls `function`, which returns Result<void, Failure>.
template <class Function>
irp_code guarded(const Function& function) noexcept {
  try {
    const Result<void, Failure> result = function();
    return result.ok() ? IRP_OK : fail(result.error());
  } catch (const std::bad_alloc&) {
    return fail_in_system("out of memory");
  } catch (const std::exception& exception) {
    return fail_in_system(exception.what());
  } catch (...) {
    return fail_in_system("unknown exception");
  }
}

}  // namespace indurop::c
