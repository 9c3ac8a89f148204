// From a march and its simulation to the summary.
#pragma once

#include "march/march.hpp"
#include "output/summary.hpp"

namespace carom {

/// What is known before the first step: program, case and mesh.
Summary summary_of(const Simulation& simulation);

/// What the march has come to: schemes, ledger, momenta, and the items of the verdict that follow from them. Only the
/// schemes of one that has not started.
void fill(Summary& summary, const Simulation& simulation, const March& march);

/// The verdict's item on the strain of rigid bodies.
VerdictItem body_strain_item(double strain);

/// Fails what did not pass; "good" and "failed" only for runs that reached the end.
void judge(Summary& summary);

}  // namespace carom
