#include <sys/auxv.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "linalg/cholesky.hpp"
#include "linalg/lapack.hpp"

namespace carom {

namespace {

struct KernelChoice {
  const char* name;                       ///< value for OPENBLAS_CORETYPE
  std::array<std::string_view, 3> equal;  ///< names under which OpenBLAS reports kernels as good
};

/// The kernels this processor deserves; name is null when the plain x86-64 ones do.
KernelChoice deserved_kernels() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
    return {"SKYLAKEX", {"SkylakeX", "Cooperlake", "Sapphirerapids"}};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return {"HASWELL", {"Haswell", "Zen", "Excavator"}};
  return {nullptr, {}};
}

/// Path of this executable, or "" when the program was started through the dynamic loader by hand
/// (then /proc/self/exe is the loader: AT_BASE is 0).
std::string_view executable(std::array<char, 4096>& buffer) {
  if (getauxval(AT_BASE) == 0) return {};
  const ssize_t length = readlink("/proc/self/exe", buffer.data(), buffer.size() - 1);
  if (length <= 0) return {};
  buffer[static_cast<std::size_t>(length)] = '\0';
  return {buffer.data(), static_cast<std::size_t>(length)};
}

}  // namespace

void prepare_blas_environment(char** argv) {
  openblas_set_num_threads(1);
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr) return;
  const KernelChoice choice = deserved_kernels();
  if (choice.name == nullptr) return;
  const std::string_view loaded = openblas_get_corename();
  for (const std::string_view good : choice.equal)
    if (loaded == good) return;
  std::array<char, 4096> buffer;
  if (executable(buffer).empty()) return;
  if (setenv("OPENBLAS_CORETYPE", choice.name, 1) != 0) return;
  if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr) setenv("OPENBLAS_NUM_THREADS", "1", 1);
  execv(buffer.data(), argv);
  // Only reached when the program could not be executed again: go on with slower kernels.
  unsetenv("OPENBLAS_CORETYPE");
}

}  // namespace carom
