// Environment variables that the numerical libraries read while they load.
#pragma once

#include <string>

namespace carom {

/// To be called first in main. Sets what must stand in the environment before the libraries load, and executes the
/// program again if anything had to be set:
/// - OPENBLAS_CORETYPE (HASWELL, SKYLAKEX): OpenBLAS 0.3.21 takes new processors for an old one;
/// - GOMP_SPINCOUNT: threads that wait give way after a moment instead of spinning for milliseconds, which on a machine
///   that others use as well costs a factor of ten (a run of 743 explicit steps on 10,240 cells, 2 threads on 2 busy
///   cores: 27.8 s spinning, 2.9 s giving way).
/// BLAS runs one thread: results must not depend on their number. What the user has set stays.
void prepare_process_environment(char** argv);

/// To stand in the .preinit_array of an executable, which comes before its libraries: where the address space is
/// limited (ulimit -v), executes the program again with OPENBLAS_NUM_THREADS=1. OpenBLAS makes its threads while it
/// loads, and one that gets no memory asks for it for ever.
void limit_blas_threads(int argc, char** argv, char** environment);

/// Where the address space is limited, takes the buffer that OpenBLAS asks for with its first call (128 MB at most in
/// 0.3.21), again and again until it gets it. False when the limit does not leave so much.
bool reserve_blas_memory();

/// The kernels that OpenBLAS has loaded, by its own name, and the value of OPENBLAS_CORETYPE for better ones, "" where
/// they are as good as the processor allows. For processes that are not ours to execute again.
struct BlasKernels {
  std::string loaded, better;
};
BlasKernels blas_kernels();

/// BLAS on one thread for a while; what it was comes back at the end.
class BlasScope {
 public:
  BlasScope();
  ~BlasScope();
  BlasScope(const BlasScope&) = delete;
  BlasScope& operator=(const BlasScope&) = delete;

 private:
  int threads_;
};

}  // namespace carom
