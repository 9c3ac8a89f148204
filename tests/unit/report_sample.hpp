// A small results folder as a run of an elastic bar against a rigid wall would leave it.
#pragma once

#include <filesystem>
#include <string>

namespace carom {

/// Title with markup in it, which the page must show as text.
inline const std::string kHostileTitle = "Elastic bar on a rigid wall <script>alert(\"x\")</script> & more";

/// Writes summary.json, energy.csv, contact.csv, probes.csv, exact.csv and case.resolved.toml with `rows` rows.
void write_sample_results(const std::filesystem::path& folder, int rows);

}  // namespace carom
