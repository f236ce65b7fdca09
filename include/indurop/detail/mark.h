// SPDX-License-Identifier: Apache-2.0
// Leaves the ABI version in the non-loaded ELF section .indurop.abi of every object that includes an InduRoP header, so
// that a module built for another version is rejected before it is loaded. One u32 per object thanks to comdat.

#pragma once

#include <indurop/detail/abi.h>

#define INDUROP_ABI_VERSION 5
static_assert(INDUROP_ABI_VERSION == indurop::abi::kVersion, "change both together");

#define INDUROP_STRINGIZE_(text) #text
#define INDUROP_STRINGIZE(text) INDUROP_STRINGIZE_(text)

asm(".pushsection .indurop.abi,\"G\",%progbits,indurop_abi_" INDUROP_STRINGIZE(INDUROP_ABI_VERSION) ",comdat\n"
    ".long " INDUROP_STRINGIZE(INDUROP_ABI_VERSION) "\n"
    ".popsection");
