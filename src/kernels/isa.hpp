// Instruction sets, and the kernels that are compiled for each.
#pragma once

#include <cstdint>
#include <string_view>

#include "kernels/kernels.hpp"

namespace carom {

/// Instruction sets for which the kernels are compiled; `reference` is the same source over plain double.
enum class Isa : std::uint8_t { reference, x86_64_v2, x86_64_v3, x86_64_v4 };

/// Best instruction set of this processor, or the one named by the environment variable CAROM_ISA
/// (reference, v2, v3, v4). Throws std::runtime_error for an unknown name or one the processor lacks.
Isa chosen_isa();
std::string_view name(Isa isa);
/// True when this processor has the instruction set.
bool supported(Isa isa);
/// Its kernels.
const KernelTable& kernels(Isa isa);

}  // namespace carom
