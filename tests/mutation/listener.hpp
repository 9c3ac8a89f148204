// For tests/main.cpp of a tree with mutants: writes a line for each test into the file that MUTANTS_LOG names, with the
// test's name, its seconds, whether it passed and the mutants that it reached.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace mutants {

class Listener : public testing::EmptyTestEventListener {
 public:
  explicit Listener(const char* path) : log_(path, std::ios::app) {}

 private:
  void OnTestEnd(const testing::TestInfo& test) override {
    const testing::TestResult& result = *test.result();
    log_ << test.test_suite_name() << '.' << test.name() << '\t' << static_cast<double>(result.elapsed_time()) / 1000.0
         << '\t' << (result.Passed() && !result.Skipped() ? 1 : 0) << '\t';
    for (int number = 0; number < capacity; ++number)
      if (reached[number] != 0) log_ << number << ' ';
    log_ << std::endl;
    std::memset(reached, 0, capacity);
  }

  std::ofstream log_;
};

/// To be called once GoogleTest is initialised.
inline void listen() {
  if (const char* path = std::getenv("MUTANTS_LOG"))
    testing::UnitTest::GetInstance()->listeners().Append(new Listener(path));
}

}  // namespace mutants
