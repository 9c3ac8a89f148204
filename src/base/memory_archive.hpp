// Values by name, kept in memory.
#pragma once

#include <algorithm>
#include <map>

#include "base/archive.hpp"

namespace carom {

/// What an archive has taken out of structs.
struct ArchivedValues {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::int64_t>> whole_numbers;
  std::map<std::string, std::vector<std::string>> texts;

  /// Of the numbers.
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& [key, values] : numbers) sum += values.size() * sizeof(double);
    for (const auto& [key, values] : whole_numbers) sum += values.size() * sizeof(std::int64_t);
    return sum;
  }
};

/// Takes values out of structs.
class MemoryWriter : public Archive {
 public:
  explicit MemoryWriter(ArchivedValues& values) : values_(values) {}

 protected:
  bool comes_in() const override { return false; }
  std::size_t extent(const std::string& /*key*/, std::size_t now) override { return now; }
  void numbers(const std::string& key, std::span<double> x) override {
    values_.numbers[key].assign(x.begin(), x.end());
  }
  void whole_numbers(const std::string& key, std::span<std::int64_t> x) override {
    values_.whole_numbers[key].assign(x.begin(), x.end());
  }
  void texts(const std::string& key, std::span<std::string> x) override {
    values_.texts[key].assign(x.begin(), x.end());
  }

 private:
  ArchivedValues& values_;
};

/// Puts them back.
class MemoryReader : public Archive {
 public:
  explicit MemoryReader(const ArchivedValues& values) : values_(values) {}

 protected:
  bool comes_in() const override { return true; }
  std::size_t extent(const std::string& key, std::size_t /*now*/) override {
    if (const auto found = values_.numbers.find(key); found != values_.numbers.end()) return found->second.size();
    if (const auto found = values_.whole_numbers.find(key); found != values_.whole_numbers.end())
      return found->second.size();
    if (const auto found = values_.texts.find(key); found != values_.texts.end()) return found->second.size();
    throw ArchiveError("\"" + key + "\" is missing");
  }
  void numbers(const std::string& key, std::span<double> x) override { take(values_.numbers, key, x); }
  void whole_numbers(const std::string& key, std::span<std::int64_t> x) override {
    take(values_.whole_numbers, key, x);
  }
  void texts(const std::string& key, std::span<std::string> x) override { take(values_.texts, key, x); }

 private:
  template <class T>
  static void take(const std::map<std::string, std::vector<T>>& from, const std::string& key, std::span<T> x) {
    const auto found = from.find(key);
    if (found == from.end()) throw ArchiveError("\"" + key + "\" is missing");
    if (found->second.size() != x.size()) throw ArchiveError("\"" + key + "\" has the wrong size");
    std::copy(found->second.begin(), found->second.end(), x.begin());
  }

  const ArchivedValues& values_;
};

}  // namespace carom
