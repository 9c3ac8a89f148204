// Cases in memory and in a temporary folder.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "build/simulation.hpp"
#include "casefile/read_case.hpp"
#include "run/run_case.hpp"

namespace carom::test {

/// A block of 2 x 2 x 3 unit cells with numbers near 1; `rest` adds or ends the sections.
inline std::string case_of_block(const std::string& rest) {
  return R"(units = "SI"
[[mesh.block]]
size = [2.0, 2.0, 3.0]
divisions = [2, 2, 3]
groups = { cells = "BODY", zmin = "FOOT", zmax = "HEAD" }
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "body"
cells = "BODY"
material = "soft"
)" + rest;
}

/// The CaseError that building the case's simulation throws.
inline CaseError case_error(const std::string& text) {
  const Case given = parse_case(text, "case.toml");
  try {
    const Simulation simulation(given);
  } catch (const CaseError& e) {
    return e;
  }
  ADD_FAILURE() << "no error for\n" << text;
  return {{}, "", "", ""};
}

/// The text with its first `from` turned into `to`, which it must have.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The columns of a CSV text by name; comment lines begin with #.
using Columns = std::map<std::string, std::vector<double>>;
inline Columns read_csv(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> names;
  Columns columns;
  for (std::string line, word; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> words;
    for (std::istringstream row(line); std::getline(row, word, ',');) words.push_back(word);
    for (std::size_t c = 0; !names.empty() && c < words.size(); ++c) columns[names[c]].push_back(std::stod(words[c]));
    if (names.empty()) names = words;
  }
  return columns;
}

/// One of them; empty when there is none of that name.
inline std::vector<double> column(const std::string& csv, const std::string& name) {
  return read_csv(csv)[name];
}

/// Last value of each.
inline std::map<std::string, double> last_row(const std::string& csv) {
  std::map<std::string, double> row;
  for (const auto& [name, values] : read_csv(csv)) row[name] = values.back();
  return row;
}

/// A temporary folder with a case in it.
class TemporaryCase {
 public:
  explicit TemporaryCase(const std::string& text) {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("carom_run_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << text;
  }
  ~TemporaryCase() { std::filesystem::remove_all(folder_); }
  TemporaryCase(const TemporaryCase&) = delete;
  TemporaryCase& operator=(const TemporaryCase&) = delete;

  ExitCode run() const {
    RunOptions options;
    options.folder = results().string();
    options.threads = 1;
    options.progress = ProgressMode::quiet;
    return run_case((folder_ / "case.toml").string(), options, std::atomic<bool>{false});
  }
  std::filesystem::path results() const { return folder_ / "out"; }
  std::string result(const std::string& file) const { return read_text(results() / file); }

 private:
  std::filesystem::path folder_;
};

}  // namespace carom::test
