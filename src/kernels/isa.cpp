#include "kernels/isa.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace carom {
namespace {

constexpr Isa best_first[] = {Isa::x86_64_v4, Isa::x86_64_v3, Isa::x86_64_v2, Isa::reference};

Isa best() {
  for (const Isa isa : best_first)
    if (supported(isa)) return isa;
  return Isa::reference;
}

}  // namespace

bool supported(Isa isa) {
  switch (isa) {
    case Isa::reference:
      return true;
    case Isa::x86_64_v2:
      return __builtin_cpu_supports("x86-64-v2") != 0;
    case Isa::x86_64_v3:
      return __builtin_cpu_supports("x86-64-v3") != 0;
    case Isa::x86_64_v4:
      return __builtin_cpu_supports("x86-64-v4") != 0;
  }
  return false;
}

std::string_view name(Isa isa) {
  switch (isa) {
    case Isa::reference:
      return "reference";
    case Isa::x86_64_v2:
      return "v2";
    case Isa::x86_64_v3:
      return "v3";
    case Isa::x86_64_v4:
      return "v4";
  }
  return "";
}

Isa chosen_isa() {
  const char* wish = std::getenv("CAROM_ISA");
  if (wish == nullptr || *wish == '\0') return best();
  for (const Isa isa : best_first) {
    if (name(isa) != wish) continue;
    if (supported(isa)) return isa;
    throw std::runtime_error("CAROM_ISA=" + std::string(wish) + ": this processor lacks x86-64-" + wish +
                             "; the best it has is " + std::string(name(best())));
  }
  throw std::runtime_error("CAROM_ISA=" + std::string(wish) +
                           ": no such instruction set; expected reference, v2, v3 or v4, or leave it unset");
}

const KernelTable& kernels(Isa isa) {
  switch (isa) {
    case Isa::x86_64_v2:
      return kernels_v2();
    case Isa::x86_64_v3:
      return kernels_v3();
    case Isa::x86_64_v4:
      return kernels_v4();
    case Isa::reference:
      break;
  }
  return kernels_reference();
}

}  // namespace carom
