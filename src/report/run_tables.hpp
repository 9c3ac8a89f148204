// Runs side by side as tables: a row for each thing, a column for each run.
#pragma once

#include <string>
#include <vector>

#include "output/data_table.hpp"
#include "report/page.hpp"

namespace carom {

struct NamedRun {
  std::string name;  ///< the end of its folder's path that tells it from the others
  ReportData data;
};

/// What runs were given that is not the same for all: keys of their cases, mesh, program. Texts that are long are cut;
/// keys are compared where every run has its case. Throws CaseError where one is not TOML.
DataTable input_differences(const std::vector<NamedRun>& runs);

/// Key figures, checks and energies at the end that are not zero in all runs. From the second run on each has beside it
/// the difference to the first: in the unit of the value and in percent of the first, or "none", or "round-off" where
/// it is below 1e-12 of the values (of energies 1e-10 of the largest).
DataTable figures_of_runs(const std::vector<NamedRun>& runs);
DataTable checks_of_runs(const std::vector<NamedRun>& runs);
DataTable energies_of_runs(const std::vector<NamedRun>& runs);

/// The largest values of contacts and probes, and those of the parts where there are several; of one run with when (and
/// where), of several with the differences as above.
DataTable largest_of_runs(const std::vector<NamedRun>& runs);
DataTable parts_of_runs(const std::vector<NamedRun>& runs);

/// All of these that have rows, as text in one of the formats of output/data_table.hpp, with empty lines between.
/// Throws as input_differences does.
std::string tables_text(const std::vector<NamedRun>& runs, const std::string& format);

}  // namespace carom
