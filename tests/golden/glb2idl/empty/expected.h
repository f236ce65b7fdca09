// Shared variables of in.glb, written by glb2idl. Do not edit.
#pragma once

#include <indurop/lock.h>
#include <indurop/var.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop_generated_6341eecd73d2a987 __attribute__((visibility("hidden"))) {
}  // namespace indurop_generated_6341eecd73d2a987
