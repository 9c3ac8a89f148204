// The report page of a run.
#pragma once

#include <string>

namespace carom {

/// Writes <results_folder>/report.html, one self-contained page that needs no network, from the files of the folder
/// alone (summary.json, energy.csv, contact.csv, probes.csv, probes_filtered.csv, exact.csv, case.resolved.toml). Files
/// that are missing or cut short leave a note on the page instead of an error. Throws OutputError when the page cannot
/// be written.
void write_report(const std::string& results_folder);

}  // namespace carom
