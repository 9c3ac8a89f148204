#include "compare/compare_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>

#include "base/errors.hpp"
#include "compare/jobs.hpp"
#include "compare/page.hpp"
#include "output/file_writer.hpp"

namespace carom::compare {

namespace {

namespace fs = std::filesystem;

std::string read_text(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string folder_of(const Settings& settings, const Variant& variant) {
  return settings.folder + "/variants/" + variant.name;
}

std::string log_of(const Settings& settings, const Variant& variant) {
  return folder_of(settings, variant) + "/run.log";
}

/// Writes the case of a variant; what an earlier comparison left in its folder is removed by the run.
Job prepare(const Settings& settings, const Variant& variant) {
  const std::string folder = folder_of(settings, variant), file = folder + "/case.toml";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, error.message());
  fs::remove(folder + "/summary.json", error);
  write_file(file, variant.case_text);
  std::vector<std::string> arguments = settings.program;
  for (const std::string& argument :
       std::array<std::string, 7>{"run", file, "--out", folder, "--threads", "1", "--quiet"})
    arguments.push_back(argument);
  return {std::move(arguments), log_of(settings, variant)};
}

std::vector<Result> run_all(const std::vector<Variant>& variants, const Settings& settings,
                            const std::atomic<bool>& stop) {
  std::vector<Job> jobs;
  std::vector<std::size_t> variant_of;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (!variants[i].refusal.empty()) continue;
    jobs.push_back(prepare(settings, variants[i]));
    variant_of.push_back(i);
  }
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::size_t done = 0;
  const auto finished = [&](std::size_t job, int) {
    ++done;
    if (settings.finished) settings.finished(done, jobs.size(), variants[variant_of[job]].label);
  };
  const ExitCodes codes = run_jobs(jobs, settings.jobs > 0 ? settings.jobs : cores, stop, finished);
  std::vector<Result> results(variants.size());
  for (std::size_t i = 0; i < variants.size(); ++i) {
    results[i].variant = variants[i];
    results[i].exit_code = static_cast<int>(ExitCode::case_wrong);
    results[i].failure = "not allowed: " + variants[i].refusal;
  }
  for (std::size_t job = 0; job < jobs.size(); ++job) {
    const Variant& variant = variants[variant_of[job]];
    results[variant_of[job]] =
        read_result(variant, folder_of(settings, variant), codes[job], read_text(log_of(settings, variant)));
  }
  return results;
}

void require_one_allowed(const std::vector<Variant>& variants, const std::string& case_file) {
  if (std::any_of(variants.begin(), variants.end(), [](const Variant& v) { return v.refusal.empty(); })) return;
  const Variant& first = variants.front();
  throw CaseError({case_file}, "", fmt::format("{} combination(s), none of which is allowed", variants.size()),
                  "at least one that is", fmt::format("The first, \"{}\": {}", first.label, first.refusal));
}

}  // namespace

std::vector<Variant> variants_in(const std::string& folder, const Base& base, const Options& options) {
  std::vector<Variant> variants = make_variants(base, options, folder + "/variants");
  require_one_allowed(variants, base.file);
  return variants;
}

Comparison compare_variants(const Base& base, const std::string& case_text, const std::vector<Variant>& variants,
                            const Options& options, const Settings& settings, const std::atomic<bool>& stop) {
  Comparison comparison;
  comparison.file = base.file;
  comparison.title = base.title;
  comparison.units = base.units;
  comparison.common = label_of(common_choice(options));
  comparison.results = run_all(variants, settings, stop);
  comparison.reference = measure(comparison.results, options.reference);
  comparison.quantity = ranking_quantity(comparison.results);
  comparison.claims = claim_errors(comparison.results, comparison.quantity);
  comparison.recommendation =
      recommend(comparison.results, comparison.quantity, comparison.reference, comparison.claims);
  write_file(settings.folder + "/compare.csv", csv_table(comparison));
  write_file(settings.folder + "/compare.json", json_table(comparison));
  write_file(settings.folder + "/compare.html", make_page(comparison, case_text));
  return comparison;
}

ExitCode compare_cases(const std::string& case_file, const Options& options, Settings settings, const Shown& shown,
                       const std::atomic<bool>& stop) {
  const Base base = read_base(case_file);
  const std::vector<Variant> variants = variants_in(settings.folder, base, options);
  if (!shown.quiet)
    settings.finished = [](std::size_t done, std::size_t all, const std::string& label) {
      fmt::print(stderr, "{} of {}: {}\n", done, all, label);
    };
  const Comparison comparison = compare_variants(base, read_text(case_file), variants, options, settings, stop);
  if (!shown.quiet) {
    // A table that goes into another document stands alone on stdout.
    const bool is_alone = !shown.format.empty() && shown.format != table_formats().front();
    fmt::print("{}", format_table(variants_table(comparison), shown.format));
    fmt::print(is_alone ? stderr : stdout, "{}", remarks_text(comparison));
    fmt::print(stderr, "results in {0}, open {0}/compare.html\n", settings.folder);
  }
  if (stop.load()) return ExitCode::run_failed;
  return comparison.recommendation.result ? ExitCode::good : ExitCode::verdict_failed;
}

}  // namespace carom::compare
