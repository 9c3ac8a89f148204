#include "output/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

namespace carom::output_progress_test {
namespace {

/// Columns of UTF-8 text: bytes that do not continue a character.
int columns(const std::string& text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// What `use` prints into a file.
template <class Use>
std::string printed(ProgressMode mode, const Use& use) {
  std::FILE* stream = std::tmpfile();
  Progress progress(stream, mode);
  use(progress);
  std::rewind(stream);
  std::string text;
  for (int c = std::fgetc(stream); c != EOF; c = std::fgetc(stream)) text += static_cast<char>(c);
  std::fclose(stream);
  return text;
}

void run_1000_steps(Progress& progress) {
  for (int step = 1; step <= 1000; ++step)
    progress.update({2.0 * step / 1000, step, 0.002, 12, 1e-13, 1000.0 - step, 0.5});
}

TEST(Progress, PipedWritesALineEveryFivePercent) {
  const std::string text = printed(ProgressMode::automatic, [](Progress& p) {
    run_1000_steps(p);
    p.finish("done");
  });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 20 + 1);
  EXPECT_EQ(text.find("  5 %  t 0.1  "), 0U) << text;
  EXPECT_NE(text.find("\n100 %  t 2  left 0 s  step 1000  dt 0.002  it 12  kinetic 0.5  energy error 1.0e-13\ndone\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, LongStepsGiveOneLineEach) {
  const std::string text = printed(ProgressMode::lines, [](Progress& p) {
    for (int step = 1; step <= 3; ++step) p.update({2.0 * step / 3, step, 2.0 / 3, 0, 0.0, 3.0 - step});
  });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
}

TEST(Progress, LiveIsRateLimitedAndClearedAtTheEnd) {
  const std::string text = printed(ProgressMode::live, [](Progress& p) {
    run_1000_steps(p);  // far less than 100 ms each, so only a few are shown
    std::this_thread::sleep_for(std::chrono::milliseconds(110));
    p.update({1.0, 500, 0.002, 3, 1e-13, 500.0});
    p.finish("done");
  });
  const auto shown = std::count(text.begin(), text.end(), '\r');
  EXPECT_GE(shown, 3);
  EXPECT_LT(shown, 100);
  EXPECT_TRUE(text.ends_with("\r\x1b[Kdone\n")) << text;
}

TEST(Progress, QuietPrintsNothing) {
  EXPECT_EQ(printed(ProgressMode::quiet,
                    [](Progress& p) {
                      run_1000_steps(p);
                      p.finish("done");
                    }),
            "");
}

TEST(Progress, LineFitsAnyWidth) {
  const ProgressUpdate now{1.23456e-4, 1234567, 1e-6, 23, 1.2e-13, 1765432.0, 2.5, 1.2e4};
  for (int width = 1; width <= 200; ++width) {
    EXPECT_LE(columns(progress_line(now, 1e5, width)), width);
  }
  EXPECT_EQ(progress_line(now, 90.0, 20), " 41 %  t 0.0001235");
  EXPECT_EQ(progress_line(now, 129.0, 60), " 41 %  t 0.0001235  left 2 min 09 s  step 1234567  dt 1e-06");
  EXPECT_TRUE(progress_line(now, 129.0, 200).ends_with("it 23  kinetic 2.5  force 1.2e+04  energy error 1.2e-13"));
}

TEST(Progress, BarIsFilledInProportion) {
  const std::string line = progress_line({1.0, 10, 0.1, 0, 0.0, 10.0}, 1.0, 120);
  const std::string full = "█", empty = "░";
  int filled = 0, open = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    filled += line.compare(i, full.size(), full) == 0 ? 1 : 0;
    open += line.compare(i, empty.size(), empty) == 0 ? 1 : 0;
  }
  EXPECT_EQ(filled, 15);
  EXPECT_EQ(open, 15);
}

TEST(Progress, TimeLeftCountsFromTheFirstStep) {
  const std::string text = printed(ProgressMode::lines, [](Progress& p) {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // a factorisation
    p.update({0.5, 1, 0.5, 0, 0.0, 2.0});
    p.update({1.0, 2, 0.5, 0, 0.0, 1.0});
    p.update({2.0, 3, 0.5, 0, 0.0, 0.0});
  });
  // Nothing is known after one step; then the steps took no time: the 300 ms before them would give 0.3 s, rounded 0.
  EXPECT_EQ(text.find("left"), text.find("left 0 s  step 2")) << text;
  const std::string slow = printed(ProgressMode::lines, [](Progress& p) {
    std::this_thread::sleep_for(std::chrono::milliseconds(900));
    p.update({1e-3, 1, 1e-3, 0, 0.0, 9.0});
    p.update({0.2, 2, 0.2, 0, 0.0, 8.0});
  });
  EXPECT_NE(slow.find("left 0 s"), std::string::npos) << slow;  // by the pace since the start it would be 4 s
}

TEST(Progress, OddTimesDoNoHarm) {
  EXPECT_NE(progress_line({0.0, 0, 0.0, 0, 0.0}, 0.0, 80), "");
  EXPECT_NE(
      progress_line({std::numeric_limits<double>::quiet_NaN(), 1, 0.1, 0, 0.0, std::numeric_limits<double>::infinity()},
                    1.0, 80),
      "");
}

}  // namespace
}  // namespace carom::output_progress_test
