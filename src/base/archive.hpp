// Values by name, on their way to a checkpoint or back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace carom {

/// What is read does not hold what was asked for.
class ArchiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// True for a number, and for (nested) arrays of numbers of fixed size.
template <class T>
inline constexpr bool is_of_doubles = std::is_same_v<T, double>;
template <class T, std::size_t n>
inline constexpr bool is_of_doubles<std::array<T, n>> = is_of_doubles<T>;

/// True for what goes as a whole number: integers, flags and enumerators.
template <class T>
inline constexpr bool is_whole = std::is_integral_v<T> || std::is_enum_v<T>;

/// Takes values out (writing) or puts them in (reading), by the same calls: a struct names its members once,
///   template <class A> void fields(A& archive, Thing& x) { archive("length", x.length); archive("nodes", x.nodes); }
/// beside its declaration, as a friend where they are private, and everything that it is a member of can name it in
/// turn. Members may be numbers, flags, enumerators, strings, fixed arrays of numbers, optionals, variants, shared
/// constants and structs, and vectors of them; those of structs go as one column for each member, so that these hold no
/// vectors, optionals or variants themselves; structs that do go one by one, by each(). What is of variable size takes
/// the size that it is read with.
class Archive {
 public:
  virtual ~Archive() = default;

  /// x by the name, which is a word of its own within its struct.
  template <class T>
  void operator()(std::string_view name, T& x) {
    const std::string key = prefix_ + std::string(name);
    if constexpr (is_of_doubles<T>) {
      numbers(key, doubles_of(&x, 1));
    } else if constexpr (is_whole<T>) {
      auto value = static_cast<std::int64_t>(x);
      whole_numbers(key, {&value, 1});
      x = static_cast<T>(value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      texts(key, {&x, 1});
    } else {
      compound(key, x);
    }
  }

  /// Every one of few structs by itself.
  template <class T>
  void each(std::string_view name, std::vector<T>& x) {
    const std::string key = prefix_ + std::string(name);
    std::size_t count = x.size();
    inside(key, "count", count);
    x.resize(count);
    for (std::size_t i = 0; i < count; ++i) inside(key, std::to_string(i), x[i]);
  }

 protected:
  /// Are values put in?
  virtual bool comes_in() const = 0;
  /// How many entries there are: `now` where they are taken out.
  virtual std::size_t extent(const std::string& key, std::size_t now) = 0;
  /// The entries, as many as there are; throws ArchiveError where that is another number.
  virtual void numbers(const std::string& key, std::span<double> values) = 0;
  virtual void whole_numbers(const std::string& key, std::span<std::int64_t> values) = 0;
  virtual void texts(const std::string& key, std::span<std::string> values) = 0;

 private:
  static constexpr std::size_t double_size = sizeof(double);

  template <class T>
  static std::span<double> doubles_of(T* first, std::size_t count) {
    static_assert(sizeof(T) % double_size == 0);
    return {reinterpret_cast<double*>(first), count * (sizeof(T) / double_size)};
  }

  /// A struct: its members stand under its name.
  template <class T>
  void compound(const std::string& key, T& x) {
    const std::string outer = std::exchange(prefix_, key + ".");
    fields(*this, x);
    prefix_ = outer;
  }

  template <class T>
  void compound(const std::string& key, std::optional<T>& x) {
    bool has_value = x.has_value();
    inside(key, "is_there", has_value);
    if (!has_value) return x.reset();
    if (!x) x.emplace();
    inside(key, "value", *x);
  }

  template <class T>
  void compound(const std::string& key, std::shared_ptr<const T>& x) {
    std::optional<T> value;
    if (x) value = *x;
    compound(key, value);
    if (comes_in()) x = value ? std::make_shared<const T>(std::move(*value)) : nullptr;
  }

  template <class... T>
  void compound(const std::string& key, std::variant<T...>& x) {
    std::size_t index = x.index();
    inside(key, "kind", index);
    if (index >= sizeof...(T)) throw ArchiveError("\"" + key + "\" is of an unknown kind");
    std::size_t i = 0;
    const auto choose = [&]<class Kind>(std::type_identity<Kind>) {
      if (i++ == index && !std::holds_alternative<Kind>(x)) x.template emplace<Kind>();
    };
    (choose(std::type_identity<T>{}), ...);
    std::visit(
        [&](auto& value) {
          if constexpr (!std::is_same_v<decltype(value), std::monostate&>) inside(key, "value", value);
        },
        x);
  }

  template <class T>
  void compound(const std::string& key, std::vector<T>& x) {
    if constexpr (is_of_doubles<T>) {
      constexpr std::size_t width = sizeof(T) / double_size;
      const std::size_t count = extent(key, width * x.size());
      if (count % width != 0) throw ArchiveError("\"" + key + "\" has the wrong size");
      x.resize(count / width);
      numbers(key, doubles_of(x.data(), x.size()));
    } else if constexpr (is_whole<T>) {
      std::vector<std::int64_t> values;
      for (const T value : x) values.push_back(static_cast<std::int64_t>(value));
      values.resize(extent(key, values.size()));
      whole_numbers(key, values);
      x.resize(values.size());
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<T>(values[i]);
    } else if constexpr (std::is_same_v<T, std::string>) {
      x.resize(extent(key, x.size()));
      texts(key, x);
    } else {
      structs(key, x);
    }
  }

  template <class T>
  void inside(const std::string& key, std::string_view name, T& x) {
    const std::string outer = std::exchange(prefix_, key + ".");
    (*this)(name, x);
    prefix_ = outer;
  }

  template <class T>
  void structs(const std::string& key, std::vector<T>& x);

  std::string prefix_;
};

/// Members of many equal structs, one column for each: what Archive makes of a vector of structs.
class ArchiveColumns {
 public:
  template <class T>
  struct Column {
    std::string name;
    std::vector<T> values;
  };

  std::vector<Column<double>> numbers;
  std::vector<Column<std::int64_t>> whole_numbers;
  std::vector<Column<std::string>> texts;
};

/// Base of the two archives between structs and their columns: from struct to struct the members come in one order.
class ArchiveRows : public Archive {
 public:
  explicit ArchiveRows(ArchiveColumns& columns) : columns_(columns) {}

 protected:
  std::size_t extent(const std::string& key, std::size_t /*now*/) override {
    throw std::logic_error("\"" + key + "\" is a vector in a vector of structs");
  }

  ArchiveColumns& columns_;
};

/// Appends the members of structs to the columns.
class ArchiveGather : public ArchiveRows {
 public:
  using ArchiveRows::ArchiveRows;

 protected:
  bool comes_in() const override { return false; }
  void numbers(const std::string& key, std::span<double> values) override { append(columns_.numbers, key, values); }
  void whole_numbers(const std::string& key, std::span<std::int64_t> values) override {
    append(columns_.whole_numbers, key, values);
  }
  void texts(const std::string& key, std::span<std::string> values) override { append(columns_.texts, key, values); }

 private:
  template <class T>
  static void append(std::vector<ArchiveColumns::Column<T>>& columns, const std::string& key, std::span<T> values) {
    auto column = columns.begin();
    while (column != columns.end() && column->name != key) ++column;
    if (column == columns.end()) column = columns.insert(column, {key, {}});
    column->values.insert(column->values.end(), values.begin(), values.end());
  }
};

/// Gives the members back, struct after struct.
class ArchiveScatter : public ArchiveRows {
 public:
  using ArchiveRows::ArchiveRows;
  void next() { ++row_; }

 protected:
  bool comes_in() const override { return true; }
  void numbers(const std::string& key, std::span<double> values) override { take(columns_.numbers, key, values); }
  void whole_numbers(const std::string& key, std::span<std::int64_t> values) override {
    take(columns_.whole_numbers, key, values);
  }
  void texts(const std::string& key, std::span<std::string> values) override { take(columns_.texts, key, values); }

 private:
  template <class T>
  void take(const std::vector<ArchiveColumns::Column<T>>& columns, const std::string& key, std::span<T> values) const {
    for (const ArchiveColumns::Column<T>& column : columns) {
      if (column.name != key) continue;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = column.values[row_ * values.size() + i];
      return;
    }
  }

  std::size_t row_ = 0;
};

template <class T>
void Archive::structs(const std::string& key, std::vector<T>& x) {
  std::size_t count = x.size();
  inside(key, "count", count);
  x.resize(count);
  ArchiveColumns columns;
  ArchiveGather gather(columns);
  for (T& one : x) fields(static_cast<Archive&>(gather), one);
  const std::string before = key + ".";
  for (auto& column : columns.numbers) numbers(before + column.name, column.values);
  for (auto& column : columns.whole_numbers) whole_numbers(before + column.name, column.values);
  for (auto& column : columns.texts) texts(before + column.name, column.values);
  ArchiveScatter scatter(columns);
  for (T& one : x) {
    fields(static_cast<Archive&>(scatter), one);
    scatter.next();
  }
}

}  // namespace carom
