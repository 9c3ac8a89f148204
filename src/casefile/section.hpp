// A section of the case format: what is declared about its keys, bound to the members of the struct that holds them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "casefile/key.hpp"
#include "casefile/values.hpp"

namespace carom {

/// Checks that the node is a table with known keys that its kind takes, all required ones and the right alternatives;
/// what is wrong is added to the errors. Returns the kind (value of the selector, "" without one), or nothing where it
/// is not known or the node is no table: then the keys cannot be read.
std::optional<std::string> check_section(const Node& node, const SectionDescription& section, const ReadContext& at);

/// True when two declarations differ at most in the kinds that they are for.
bool same_but_kinds(const KeyDescription& a, const KeyDescription& b);

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

  /// Other keys in place of these, for sections that name what they take their keys from; nothing: these.
  std::function<std::optional<SectionSchema>(const Node&, const ReadContext&)> instead_of_read;
  std::function<std::optional<SectionSchema>(const S&)> instead_of_write;

  void add(KeyDescription key, Handlers handlers) {
    handlers_.push_back({{key.options.kinds, std::move(handlers)}});
    description.keys.push_back(std::move(key));
  }

  /// A kind of the section that has a struct of its own among those of a variant, which holds it from the selector on:
  /// its keys, taken where the selector says `name`, and its rules, called after those of the section. Keys that
  /// several kinds declare in the same words are one in the description.
  template <class Kind, class... Kinds>
  void kind(const std::string& name, std::variant<Kinds...> S::*member, const SectionSchema<Kind>& keys);

  /// A key whose value is stored in a member, of S or of a base of it.
  template <class M, class Base>
  void key(const std::string& name, M Base::*member, const std::string& doc, KeyOptions options = {}) {
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
  void table(const std::string& name, std::optional<Sub> S::*member, const SectionSchema<Sub>& sub,
             KeyOptions options = {});
  /// [[name]]
  template <class Sub>
  void tables(const std::string& name, std::vector<Sub> S::*member, const SectionSchema<Sub>& sub,
              KeyOptions options = {});
  /// [name.NAME]; the name goes to Sub::name.
  template <class Sub>
  void named_tables(const std::string& name, std::vector<Sub> S::*member, const SectionSchema<Sub>& sub,
                    KeyOptions options = {});

  /// Reads all keys that can be; what is wrong is added to the errors, and the rules between the keys are not asked
  /// then.
  void read(S& s, const Node& node, const ReadContext& at) const;
  /// `root` is nullptr for the root section itself.
  Node write(const S& s, const Node* root) const;

 private:
  template <class>
  friend class SectionSchema;

  /// What is done about a key in some kinds; empty: in all.
  struct ForKinds {
    std::vector<std::string> kinds;
    Handlers handlers;
  };
  struct OwnKind {
    std::string name;
    std::function<void(S&)> begin;
    Finish finish;
  };

  /// Of a key that the kind takes.
  const Handlers& handlers_of(std::size_t key, const std::string& kind) const {
    for (const ForKinds& some : handlers_[key])
      for (const std::string& name : some.kinds)
        if (name == kind) return some.handlers;
    return handlers_[key].front().handlers;
  }
  KeyDescription describe_section(const std::string& name, Shape shape, const SectionDescription& sub,
                                  KeyOptions options) const;

  std::vector<std::vector<ForKinds>> handlers_;  ///< one entry per key of the description
  std::vector<OwnKind> own_kinds_;
};

}  // namespace carom

#include "casefile/section_impl.hpp"
