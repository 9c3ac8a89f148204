#include "linalg/process_environment.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>

/// Stands in for the library's function: an OpenBLAS that does not know this processor, until it is told.
extern "C" char* openblas_get_corename() {
  static char old_processor[] = "Prescott";
  return old_processor;
}

namespace carom::linalg_process_environment_test {
namespace {

constexpr int executed_again = 42;

class ProcessEnvironmentDeathTest : public testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }  // OpenBLAS has started threads already
};

bool is(const char* variable, const char* value) {
  const char* found = std::getenv(variable);
  return found != nullptr && std::strcmp(found, value) == 0;
}

/// Runs before the tests: the program executed again ends here and tells what it was given.
const bool is_parent = [] {
  if (std::getenv("CAROM_TEST_EXECUTED_AGAIN") == nullptr) return true;
  const bool good = is("OPENBLAS_NUM_THREADS", "1") && is("GOMP_SPINCOUNT", "1000") &&
                    (is("OPENBLAS_CORETYPE", "HASWELL") || is("OPENBLAS_CORETYPE", "SKYLAKEX"));
  _exit(good ? executed_again : 1);
}();

void prepare() {
  std::string name = "carom", option = "--gtest_list_tests";
  char* argv[] = {name.data(), option.data(), nullptr};
  prepare_process_environment(argv);
}

TEST_F(ProcessEnvironmentDeathTest, ExecutesAgainWhenOpenBlasTakesTheProcessorForAnOldOne) {
  ASSERT_TRUE(is_parent);
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "the plain kernels are the right ones for this processor";
  const auto run = [] {
    unsetenv("OPENBLAS_CORETYPE");
    unsetenv("OPENBLAS_NUM_THREADS");
    unsetenv("OMP_WAIT_POLICY");
    unsetenv("GOMP_SPINCOUNT");
    setenv("CAROM_TEST_EXECUTED_AGAIN", "1", 1);
    prepare();
    _exit(2);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(executed_again), "");
}

TEST_F(ProcessEnvironmentDeathTest, LeavesVariablesThatAreSetAlone) {
  const auto run = [] {
    setenv("OPENBLAS_CORETYPE", "Nehalem", 1);
    setenv("OMP_WAIT_POLICY", "active", 1);
    setenv("CAROM_TEST_EXECUTED_AGAIN", "1", 1);
    prepare();
    _exit(is("OPENBLAS_CORETYPE", "Nehalem") ? 3 : 2);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace carom::linalg_process_environment_test
