// The report page of a run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/page.hpp"

namespace carom {

/// Writes <results_folder>/report.html, or `file` where it is not "": one self-contained page that needs no network,
/// from the files of the folder alone (summary.json, energy.csv, contact.csv, probes.csv, probes_filtered.csv,
/// exact.csv, case.resolved.toml, the frames and their index). Files that are missing or cut short leave a note on the
/// page instead of an error. Throws OutputError when the page cannot be written.
void write_report(const std::string& results_folder, const std::string& file = "");

/// A page with nothing but the view of a folder's frames, in about so many bytes. Throws std::runtime_error where there
/// is none, and says why.
std::string view_page(const std::string& results_folder, std::size_t most_bytes);

/// Writes <results_folder>/watch.html, the page of a run that goes on: how far it is, its curves so far; no view.
/// Returns the time that it has reached. Throws OutputError.
double write_watch_page(const std::string& results_folder, const RunningState& state);
/// The run has ended: the page leads to the report.
void end_watch_page(const std::string& results_folder);

/// Several runs on one page: what differs in their inputs, their key figures, checks and energies column by column with
/// the differences to the first, their curves laid over each other, their views side by side, at one time. `file` is
/// the page. Throws CaseError for runs in different units and OutputError.
void write_comparison(const std::vector<std::string>& results_folders, const std::string& file);

/// The tables of that page, of one run or several, as text in one of the formats of output/data_table.hpp, with empty
/// lines between. Throws CaseError for runs in different units and for cases that are not TOML.
std::string tables_of_runs(const std::vector<std::string>& results_folders, const std::string& format);

}  // namespace carom
