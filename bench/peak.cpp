// Peak of multiplications and additions on one core, for each instruction set: what the kernels are read beside.
#include "peak.hpp"

#include <benchmark/benchmark.h>

namespace {

void peak(benchmark::State& state, double (*loop)(std::size_t, double), int lanes) {
  constexpr std::size_t rounds = 1'000'000;
  double factor = 0.5;
  for (auto _ : state) {
    benchmark::DoNotOptimize(factor);
    benchmark::DoNotOptimize(loop(rounds, factor));
  }
  state.counters["GFlop/s"] = benchmark::Counter(2e-9 * static_cast<double>(rounds) * carom::peak_chains * lanes,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (__builtin_cpu_supports("x86-64-v2") != 0) benchmark::RegisterBenchmark("peak/v2", peak, carom::peak_v2, 2);
  if (__builtin_cpu_supports("x86-64-v3") != 0) benchmark::RegisterBenchmark("peak/v3", peak, carom::peak_v3, 4);
  if (__builtin_cpu_supports("x86-64-v4") != 0) benchmark::RegisterBenchmark("peak/v4", peak, carom::peak_v4, 8);
  benchmark::RunSpecifiedBenchmarks();
}
