// SPDX-License-Identifier: Apache-2.0
// Standard input, output and error of a program.

#pragma once

#include <chrono>
#include <string_view>

namespace indurop::base {

// Opens /dev/null for those that are closed: else the next file that is opened takes their number, and what is printed
// is written into that file. To be called before any other file is opened.
void open_standard_files() noexcept;

// For programs that must not wait for the reader of their output: a stopped terminal (Ctrl-S), a pipe that is not read.
// They do not wait for a lock of stdio either, which a thread that prints may hold. Thread-safe, not real-time safe.

// How long a program that ends waits for the reader of what it prints.
inline constexpr std::chrono::milliseconds kPatienceAtEnd{1000};

// Writes "PREFIX TEXT" as a line to standard error. If it is not taken within 100 ms, the line is dropped, and so are
// the next ones until it is read again; a line then says how many were.
void report_line(std::string_view prefix, std::string_view text);

// Returns false if what was printed to standard output is not taken within `patience`.
bool flush_standard_output(std::chrono::milliseconds patience) noexcept;

// Prints to standard output; returns false if a part of it is not taken within `patience`. The rest is dropped.
bool print_within(std::chrono::milliseconds patience, std::string_view text) noexcept;

}  // namespace indurop::base
