// A section of the case format: what is declared about its keys, bound to the members of the struct that holds them.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "casefile/key.hpp"
#include "casefile/values.hpp"

namespace carom {

/// Checks that the node is a table with known keys that its kind takes, all required ones and the right alternatives.
/// Returns the kind (value of the selector, "" without one).
std::string check_section(const Node& node, const SectionDescription& section, const ReadContext& at);

/// The entries of a [[list]]; CaseError when the node is no list of tables.
const List& entries_of(const Node& node, const KeyDescription& key, const ReadContext& at);
/// The members of a table of named things; CaseError when the node is no table.
const Table& members_of(const Node& node, const KeyDescription& key, const ReadContext& at);

template <class S>
class SectionSchema {
 public:
  struct Handlers {
    std::function<void(S&, const Node&, const ReadContext&)> read;
    /// The value of the key, or nothing. `root` is the case written so far.
    std::function<std::optional<Node>(const S&, const Node& root)> write;
    std::function<void(S&, const ReadContext&, const Location&)> absent = [](S&, const ReadContext&, const Location&) {
    };
  };
  using Finish = std::function<void(S&, const Node&, const ReadContext&)>;

  explicit SectionSchema(std::string doc) { description.doc = std::move(doc); }

  SectionDescription description;
  /// Rules between the keys of the section, and defaults that follow from them; called last.
  Finish finish = [](S&, const Node&, const ReadContext&) {};

  void add(KeyDescription key, Handlers handlers) {
    description.keys.push_back(std::move(key));
    handlers_.push_back(std::move(handlers));
  }

  /// A key whose value is stored in a member.
  template <class M>
  void key(const std::string& name, M S::*member, const std::string& doc, KeyOptions options = {}) {
    key_by(
        name, [member](auto& s) -> auto& { return s.*member; }, doc, std::move(options));
  }

  /// A key whose value is stored where access(S&) says.
  template <class Access>
  void key_by(const std::string& name, Access access, const std::string& doc, KeyOptions options = {});

  /// [name], stored in a member; an absent one has its defaults.
  template <class Sub>
  void table(const std::string& name, Sub S::*member, const SectionSchema<Sub>& sub, KeyOptions options = {});
  /// [name], stored in a member that is empty when the section is absent.
  template <class Sub>
  void table(const std::string& name, std::optional<Sub> S::*member, const SectionSchema<Sub>& sub);
  /// [[name]]
  template <class Sub>
  void tables(const std::string& name, std::vector<Sub> S::*member, const SectionSchema<Sub>& sub,
              KeyOptions options = {});
  /// [name.NAME]; the name goes to Sub::name.
  template <class Sub>
  void named_tables(const std::string& name, std::vector<Sub> S::*member, const SectionSchema<Sub>& sub,
                    KeyOptions options = {});

  void read(S& s, const Node& node, const ReadContext& at) const;
  /// `root` is nullptr for the root section itself.
  Node write(const S& s, const Node* root) const;

 private:
  KeyDescription describe_section(const std::string& name, Shape shape, const SectionDescription& sub,
                                  KeyOptions options) const;

  std::vector<Handlers> handlers_;  ///< one entry per key of the description
};

}  // namespace carom

#include "casefile/section_impl.hpp"
