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
