// Member templates of Section; include casefile/section.hpp.
#pragma once

#include "casefile/section.hpp"

namespace carom {

/// The kind of a section that is being written: from its own key, from the case written so far, or the default.
std::string written_kind(const Node& node, const Node& root, const SectionDescription& section);

/// True for "".
bool is_empty_text(const Node& node);

template <class S>
void place_section(S& s, const Location& where) {
  if constexpr (requires { s.where; }) s.where = where;
}

template <class S>
template <class Access>
void SectionSchema<S>::key_by(const std::string& name, Access access, const std::string& doc, KeyOptions options) {
  using Value = std::remove_cvref_t<decltype(access(std::declval<S&>()))>;
  KeyDescription described{name, shape_of<Value>(options), doc, std::move(options), {}, {}};
  const S defaults{};
  const std::optional<Node> initial = encode(access(defaults), described.options);
  const bool starts_empty = initial && is_empty_text(*initial);  // then "" is as good as no key
  if (described.options.need == KeyOptions::Need::optional && described.options.required_for.empty() &&
      described.options.default_phrase.empty() && initial && !starts_empty) {
    described.default_value = initial;
  }
  Handlers handlers;
  handlers.read = [access, described](S& s, const Node& node, const ReadContext& at) {
    decode(node, described, at, access(s));
  };
  handlers.write = [access, described, starts_empty](const S& s, const Node&) {
    std::optional<Node> node = encode(access(s), described.options);
    if (node && starts_empty && is_empty_text(*node)) node.reset();
    return node;
  };
  handlers.absent = [access](S& s, const ReadContext&, const Location& where) { place_default(access(s), where); };
  add(std::move(described), std::move(handlers));
}

template <class S>
KeyDescription SectionSchema<S>::describe_section(const std::string& name, Shape shape, const SectionDescription& sub,
                                                  KeyOptions options) const {
  return {name, shape, sub.doc, std::move(options), {}, std::make_shared<const SectionDescription>(sub)};
}

template <class S>
template <class Sub>
void SectionSchema<S>::table(const std::string& name, Sub S::*member, const SectionSchema<Sub>& sub,
                             KeyOptions options) {
  Handlers handlers;
  handlers.read = [member, sub](S& s, const Node& node, const ReadContext& at) {
    place_section(s.*member, node.where);
    sub.read(s.*member, node, at);
  };
  handlers.write = [member, sub](const S& s, const Node& root) { return sub.write(s.*member, &root); };
  handlers.absent = [read = handlers.read](S& s, const ReadContext& at, const Location& where) {
    read(s, Node{Table{}, where}, at);
  };
  add(describe_section(name, Shape::section, sub.description, std::move(options)), std::move(handlers));
}

template <class S>
template <class Sub>
void SectionSchema<S>::table(const std::string& name, std::optional<Sub> S::*member, const SectionSchema<Sub>& sub,
                             KeyOptions options) {
  Handlers handlers;
  handlers.read = [member, sub](S& s, const Node& node, const ReadContext& at) {
    Sub& value = (s.*member).emplace();
    place_section(value, node.where);
    sub.read(value, node, at);
  };
  handlers.write = [member, sub](const S& s, const Node& root) -> std::optional<Node> {
    if (!(s.*member)) return std::nullopt;
    return sub.write(*(s.*member), &root);
  };
  add(describe_section(name, Shape::section, sub.description, std::move(options)), std::move(handlers));
}

template <class S>
template <class Sub>
void SectionSchema<S>::tables(const std::string& name, std::vector<Sub> S::*member, const SectionSchema<Sub>& sub,
                              KeyOptions options) {
  const KeyDescription described = describe_section(name, Shape::sections, sub.description, std::move(options));
  Handlers handlers;
  handlers.read = [member, sub, described](S& s, const Node& node, const ReadContext& at) {
    const List& entries = entries_of(node, described, at);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      Sub& value = (s.*member).emplace_back();
      place_section(value, entries[i].where);
      sub.read(value, entries[i], at.entry(i));
    }
  };
  handlers.write = [member, sub](const S& s, const Node& root) -> std::optional<Node> {
    List entries;
    for (const Sub& value : s.*member) entries.push_back(sub.write(value, &root));
    if (entries.empty()) return std::nullopt;
    return Node{std::move(entries), {}};
  };
  add(described, std::move(handlers));
}

template <class S>
template <class Sub>
void SectionSchema<S>::named_tables(const std::string& name, std::vector<Sub> S::*member, const SectionSchema<Sub>& sub,
                                    KeyOptions options) {
  const KeyDescription described = describe_section(name, Shape::named_sections, sub.description, std::move(options));
  Handlers handlers;
  handlers.read = [member, sub, described](S& s, const Node& node, const ReadContext& at) {
    for (const Member& m : members_of(node, described, at).members) {
      Sub& value = (s.*member).emplace_back();
      value.name = m.key;
      place_section(value, m.value.where);
      sub.read(value, m.value, at.at(m.key));
    }
  };
  handlers.write = [member, sub](const S& s, const Node& root) -> std::optional<Node> {
    Table table;
    for (const Sub& value : s.*member) table.members.push_back({value.name, {}, sub.write(value, &root)});
    if (table.members.empty()) return std::nullopt;
    return Node{std::move(table), {}};
  };
  add(described, std::move(handlers));
}

template <class S>
template <class Kind, class... Kinds>
void SectionSchema<S>::kind(const std::string& name, std::variant<Kinds...> S::*member,
                            const SectionSchema<Kind>& keys) {
  for (std::size_t i = 0; i < keys.handlers_.size(); ++i) {
    KeyDescription key = keys.description.keys[i];
    key.options.kinds = {name};
    const typename SectionSchema<Kind>::Handlers own = keys.handlers_[i].front().handlers;
    Handlers handlers;
    handlers.read = [member, own](S& s, const Node& node, const ReadContext& at) {
      own.read(std::get<Kind>(s.*member), node, at);
    };
    handlers.write = [member, own](const S& s, const Node& root) { return own.write(std::get<Kind>(s.*member), root); };
    handlers.absent = [member, own](S& s, const ReadContext& at, const Location& where) {
      own.absent(std::get<Kind>(s.*member), at, where);
    };
    std::size_t known = 0;
    while (known < description.keys.size() && !same_but_kinds(description.keys[known], key)) ++known;
    if (known == description.keys.size()) {
      add(std::move(key), std::move(handlers));
      continue;
    }
    description.keys[known].options.kinds.push_back(name);
    handlers_[known].push_back({{name}, std::move(handlers)});
  }
  own_kinds_.push_back({name, [member](S& s) { (s.*member).template emplace<Kind>(); },
                        [member, finish = keys.finish](S& s, const Node& node, const ReadContext& at) {
                          finish(std::get<Kind>(s.*member), node, at);
                        }});
}

template <class S>
void SectionSchema<S>::read(S& s, const Node& node, const ReadContext& at) const {
  if (instead_of_read) {
    std::optional<SectionSchema> other;
    if (!at.errors.attempt([&] { other = instead_of_read(node, at); })) return;
    if (other) return other->read(s, node, at);
  }
  const std::size_t before = at.errors.size();
  const std::optional<std::string> found = check_section(node, description, at);
  if (!found) return;
  const std::string& kind = *found;
  const Table& table = std::get<Table>(node.value);
  for (const OwnKind& own : own_kinds_)
    if (own.name == kind) own.begin(s);
  for (std::size_t i = 0; i < handlers_.size(); ++i) {
    const KeyDescription& declared = description.keys[i];
    if (!applies(declared, kind)) continue;
    const Handlers& handlers = handlers_of(i, kind);
    const Node* value = table.find(declared.key);
    if (value != nullptr)
      at.errors.attempt([&] { handlers.read(s, *value, at.at(declared.key)); });
    else if (!required(declared, kind))
      at.errors.attempt([&] { handlers.absent(s, at.at(declared.key), node.where); });
  }
  if (at.errors.size() != before) return;
  at.errors.attempt([&] {
    finish(s, node, at);
    for (const OwnKind& own : own_kinds_)
      if (own.name == kind) own.finish(s, node, at);
  });
}

template <class S>
Node SectionSchema<S>::write(const S& s, const Node* root) const {
  if (instead_of_write)
    if (const std::optional<SectionSchema> other = instead_of_write(s)) return other->write(s, root);
  Node node{Table{}, {}};
  const Node& whole = root != nullptr ? *root : node;
  for (std::size_t i = 0; i < handlers_.size(); ++i) {
    const KeyDescription& declared = description.keys[i];
    const std::string kind = written_kind(node, whole, description);
    if (!applies(declared, kind)) continue;
    std::optional<Node> value = handlers_of(i, kind).write(s, whole);
    if (value) std::get<Table>(node.value).members.push_back({declared.key, {}, std::move(*value)});
  }
  return node;
}

}  // namespace carom
