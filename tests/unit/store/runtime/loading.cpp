// SPDX-License-Identifier: Apache-2.0
// A library whose construction calls the program that loads it.

extern "C" void indurop_test_while_loading();
extern "C" void indurop_test_nothing() {}

namespace {

struct Loaded {
  Loaded() { indurop_test_while_loading(); }
} loaded;

}  // namespace
