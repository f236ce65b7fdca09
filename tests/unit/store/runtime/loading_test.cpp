// SPDX-License-Identifier: Apache-2.0
// dlopen() holds the lock of the loader while the constructors of a library register what it uses.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <exception>
#include <thread>

#include <indurop/generated.h>
#include "hosted.h"
#include "store/runtime/module_file.h"

namespace {

int bound = 0;

}  // namespace

extern "C" void indurop_test_while_loading() {
  std::thread supervisor([] {
    const void* const inside = &decltype(knu::Robot::tick)::tag_type::ref();
    indurop::runtime::bind_apart(inside);
    indurop::runtime::bind_back(inside);
    ++bound;
  });
  supervisor.join();
}

namespace {

// Otherwise, a node hung for ever if it exchanged one module while it loaded another.
TEST(Loading, Of_a_library_does_not_block_threads_that_bind_others) {
  indurop::testing::TestNode node;
  const indurop::testing::Hosted hosted(node);
  void* const library = ::dlopen(LOADING_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << ::dlerror();
  EXPECT_EQ(bound, 1);
  EXPECT_EQ(indurop::runtime::path_of(::dlsym(library, "indurop_test_nothing")), LOADING_LIBRARY);
  EXPECT_EQ(::dlclose(library), 0);
}

TEST(Loading, Files_differ_where_those_of_dladdr_do) {
  static const int here = 0;
  const void* const places[] = {&here, reinterpret_cast<const void*>(&::dlopen),
                                reinterpret_cast<const void*>(&std::terminate), &bound};
  for (const void* const place : places) {
    for (const void* const other : places) {
      Dl_info first{};
      Dl_info second{};
      ASSERT_NE(::dladdr(place, &first), 0);
      ASSERT_NE(::dladdr(other, &second), 0);
      EXPECT_EQ(indurop::runtime::image_of(place) == indurop::runtime::image_of(other),
                first.dli_fbase == second.dli_fbase);
    }
  }
  EXPECT_EQ(indurop::runtime::path_of(&here), "/proc/self/exe");
  const int on_the_stack = 0;
  EXPECT_EQ(indurop::runtime::image_of(&on_the_stack), nullptr);
  EXPECT_EQ(indurop::runtime::path_of(&on_the_stack), "");
}

}  // namespace
