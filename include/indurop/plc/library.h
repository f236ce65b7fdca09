// SPDX-License-Identifier: Apache-2.0
// The standard functions and function blocks of IEC 61131-3, for the C++ generated from PLC programs. Hand-written
// modules may use them too: they need only the standard library.

#pragma once

#include <indurop/plc/arithmetic.h>
#include <indurop/plc/bistables.h>
#include <indurop/plc/bits.h>
#include <indurop/plc/calendar.h>
#include <indurop/plc/compare.h>
#include <indurop/plc/control.h>
#include <indurop/plc/convert.h>
#include <indurop/plc/counters.h>
#include <indurop/plc/fault.h>
#include <indurop/plc/math.h>
#include <indurop/plc/object.h>
#include <indurop/plc/pointer.h>
#include <indurop/plc/scan.h>
#include <indurop/plc/select.h>
#include <indurop/plc/slice.h>
#include <indurop/plc/text.h>
#include <indurop/plc/text_read.h>
#include <indurop/plc/text_write.h>
#include <indurop/plc/timers.h>
#include <indurop/plc/types.h>
#include <indurop/plc/wide.h>
