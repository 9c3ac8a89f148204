// The tables of the report page as HTML sections.
#pragma once

#include <string>
#include <vector>

#include "output/summary.hpp"
#include "output/units.hpp"

namespace carom {

/// Items of the verdict with value, limit and explanation.
std::string verdict_table(const Summary& summary);
/// What the run was warned of; "" when there is nothing.
std::string warnings_list(const Summary& summary);
/// What a deck has lost on its way to a case, as the user has accepted it.
std::vector<std::string> lost_of_deck(const Summary& summary);
/// What was chosen or mended, without that; likewise.
std::string notes_list(const Summary& summary);
/// Checks with value, reference, difference, tolerance and source; "" when the case has none.
std::string checks_table(const Summary& summary, const Units& units);
/// Energies at the end by term, the same in Code_Aster's terms, and the momentum balances.
std::string ledger_tables(const Summary& summary, const Units& units);
/// Case, mesh, scheme, program and cost.
std::string run_table(const Summary& summary, const Units& units);

}  // namespace carom
