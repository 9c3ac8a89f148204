// The three kinds of error: CaseError before the run, RunError during it, assert for a bug.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// A place in a file the user wrote. line and column are 1-based; 0 means "not known" (binary files, defaults).
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column", leaving out what is not known.
std::string to_string(const Location& where);

/// The case or its mesh is wrong; thrown before anything is run (exit code 2).
class CaseError : public std::runtime_error {
 public:
  /// key: dotted path such as `materials.steel.E`, or the section of a mesh file; may be empty.
  /// found, expected, suggestion: short phrases; suggestion says how to mend it and may be empty.
  CaseError(Location where, std::string key, std::string found, std::string expected, std::string suggestion = {});
  /// Several in one: the message has a line for each and their number, the parts are those of the first.
  explicit CaseError(std::vector<CaseError> all);

  const Location& where() const { return where_; }
  const std::string& key() const { return key_; }
  const std::string& found() const { return found_; }
  const std::string& expected() const { return expected_; }
  const std::string& suggestion() const { return suggestion_; }
  /// Of several in one, each of them; else empty.
  const std::vector<CaseError>& all() const;

 private:
  Location where_;
  std::string key_, found_, expected_, suggestion_;
  std::shared_ptr<const std::vector<CaseError>> all_;
};

/// Errors that are found one after the other, to be thrown together.
class CaseErrors {
 public:
  /// True when `work` throws no CaseError; one that it throws is kept.
  template <class Work>
  bool attempt(const Work& work) {
    try {
      work();
      return true;
    } catch (const CaseError& error) {
      add(error);
      return false;
    }
  }
  /// Each message once, in the order of the lines of a file.
  void add(const CaseError& error);
  std::size_t size() const { return errors_.size(); }
  bool empty() const { return errors_.empty(); }
  const std::vector<CaseError>& all() const { return errors_; }
  /// Throws what was found.
  void check() const;

 private:
  std::vector<CaseError> errors_;
};

/// The run failed after it had started (exit code 3); what was computed is kept.
class RunError : public std::runtime_error {
 public:
  RunError(int step, double time, const std::string& message);
  int step() const { return step_; }
  double time() const { return time_; }

 private:
  int step_;
  double time_;
};

/// A file or folder of results could not be written (exit code 3); the message names the path and the reason.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& path, const std::string& reason);
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The candidate nearest to `word` in edit distance (case-insensitive), or "" when none is near enough
/// (distance above a third of the length, at least 1).
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace carom
