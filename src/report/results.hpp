// What a results folder holds, ready to be shown.
#pragma once

#include <cstddef>
#include <string>

#include "report/page.hpp"

namespace carom {

/// Everything but the view, as far as it is there: what is missing or damaged is said in the notes.
ReportData read_results(const std::string& folder);

/// Fills in what follows from the tables of a run, its summary and its units: figures, largest values and charts.
void show_tables(ReportData& data, const Tables& tables);

/// The view of the folder's frames in about so many bytes under this title, or a note why there is none.
void add_view(ReportData& data, std::size_t most_bytes, const std::string& title);

/// The bytes that the views of a page may take beside the `rest` bytes of it: what is left of six million, but two
/// million at least.
std::size_t bytes_of_views(std::size_t rest);

}  // namespace carom
