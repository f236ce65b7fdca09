// Shared variables of in.glb, written by glb2idl. Do not edit.
#pragma once

#include <indurop/lock.h>
#include <indurop/var.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop_generated_90b39ab7ad8a7a88 __attribute__((visibility("hidden"))) {
}  // namespace indurop_generated_90b39ab7ad8a7a88
