#include "linalg/process_environment.hpp"

#include <sys/auxv.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "linalg/dense.hpp"
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

/// Name for OPENBLAS_CORETYPE when OpenBLAS has chosen worse kernels than this processor deserves, else null.
const char* better_kernels() {
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr) return nullptr;
  const KernelChoice choice = deserved_kernels();
  if (choice.name == nullptr) return nullptr;
  const std::string_view loaded = openblas_get_corename();
  const bool good = std::find(choice.equal.begin(), choice.equal.end(), loaded) != choice.equal.end();
  return good ? nullptr : choice.name;
}

bool is_space_limited() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace

void prepare_process_environment(char** argv) {
  openblas_set_num_threads(1);
  std::vector<std::pair<const char*, const char*>> wanted;
  if (std::getenv("GOMP_SPINCOUNT") == nullptr && std::getenv("OMP_WAIT_POLICY") == nullptr) {
    wanted.emplace_back("GOMP_SPINCOUNT", "1000");
  }
  if (const char* kernels = better_kernels()) {
    wanted.emplace_back("OPENBLAS_CORETYPE", kernels);
    if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr) wanted.emplace_back("OPENBLAS_NUM_THREADS", "1");
  }
  std::array<char, 4096> buffer;
  if (wanted.empty() || executable(buffer).empty()) return;
  for (const auto& [name, value] : wanted) {
    if (setenv(name, value, 1) != 0) return;
  }
  execv(buffer.data(), argv);
  // Only reached when the program could not be executed again: go on, only slower.
  for (const auto& [name, value] : wanted) unsetenv(name);
}

/// The C library has no environment yet: everything is in `environment`.
void limit_blas_threads(int /*argc*/, char** argv, char** environment) {
  static constexpr std::string_view name = "OPENBLAS_NUM_THREADS=";
  static char setting[] = "OPENBLAS_NUM_THREADS=1";
  static std::array<char*, 4096> more;
  if (!is_space_limited()) return;
  std::size_t count = 0;
  for (char** one = environment; *one != nullptr; ++one) {
    if (std::string_view(*one).starts_with(name) || count + 2 == more.size()) return;
    more[count++] = *one;
  }
  more[count] = setting;
  std::array<char, 4096> buffer;
  if (!executable(buffer).empty()) execve(buffer.data(), argv, more.data());
}

bool reserve_blas_memory() {
  constexpr std::size_t most = 160U << 20U;
  if (!is_space_limited()) return true;
  void* const space = mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (space == MAP_FAILED) return false;
  munmap(space, most);
  symmetric_eigen({4.0, 1.0, 2.0, 1.0, 5.0, 3.0, 2.0, 3.0, 6.0}, 3);
  return true;
}

BlasKernels blas_kernels() {
  const char* better = better_kernels();
  return {openblas_get_corename(), better != nullptr ? better : ""};
}

BlasScope::BlasScope() : threads_(openblas_get_num_threads()) {
  if (threads_ != 1) openblas_set_num_threads(1);
}

BlasScope::~BlasScope() {
  if (threads_ != 1) openblas_set_num_threads(threads_);
}

}  // namespace carom
