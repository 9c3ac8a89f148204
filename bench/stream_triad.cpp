// STREAM triad a = b + s c (McCalpin 1995): the memory bandwidth beside which the kernels are read. Bytes are counted
// as STREAM does, 24 per entry; the line of `a` that the processor reads before it writes is not counted.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <memory>

#include "parallel/threads.hpp"

namespace {

constexpr std::size_t entries = 16'000'000;  // 384 MB in three arrays: several times the largest cache
constexpr std::size_t grain = 16'384;

void stream_triad(benchmark::State& state) {
  carom::set_threads(static_cast<int>(state.range(0)));
  // Not initialised here, so that each thread first touches the pages it will use.
  const auto a = std::make_unique_for_overwrite<double[]>(entries);
  const auto b = std::make_unique_for_overwrite<double[]>(entries);
  const auto c = std::make_unique_for_overwrite<double[]>(entries);
  carom::parallel_for(entries, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      a[i] = 0.0;
      b[i] = 1.0;
      c[i] = 2.0;
    }
  });
  const double scale = 3.0;
  for (auto _ : state) {
    carom::parallel_for(entries, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + scale * c[i];
    });
    benchmark::ClobberMemory();
  }
  if (a[entries / 2] != 7.0) state.SkipWithError("wrong result");
  state.counters["GB/s"] =
      benchmark::Counter(24e-9 * static_cast<double>(entries), benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(stream_triad)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
