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

namespace indurop_generated_620d145e4b82941e __attribute__((visibility("hidden"))) {
}  // namespace indurop_generated_620d145e4b82941e
