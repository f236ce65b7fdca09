// SPDX-License-Identifier: Apache-2.0
// Everything a module author needs, in addition to <indurop/generated.h> with the shared variables of the project's
// .glb files.

#pragma once

#include <indurop/channel.h>
#include <indurop/function.h>
#include <indurop/irp.h>
#include <indurop/lock.h>
#include <indurop/module.h>
#include <indurop/pool.h>
#include <indurop/print.h>
#include <indurop/result.h>
#include <indurop/snapshot.h>
#include <indurop/state.h>
#include <indurop/string.h>
#include <indurop/var.h>

// Not needed by InduRoP itself: Figure 13 of the chapter writes to std::cout and includes no other header.
#include <iostream>
