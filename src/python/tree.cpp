#include "python/tree.hpp"

#include <variant>

namespace carom::python {

namespace {

struct ToPython {
  py::object operator()(bool value) const { return py::bool_(value); }
  py::object operator()(std::int64_t value) const { return py::int_(value); }
  py::object operator()(double value) const { return py::float_(value); }
  py::object operator()(const std::string& value) const { return py::str(value); }
  py::object operator()(const List& value) const {
    py::list list;
    for (const Node& entry : value) list.append(to_python(entry));
    return list;
  }
  py::object operator()(const Table& value) const {
    py::dict dict;
    for (const Member& member : value.members) dict[py::str(member.key)] = to_python(member.value);
    return dict;
  }
  py::object operator()(Date) const { return py::none(); }
};

/// Of one conversion.
class FromPython {
 public:
  explicit FromPython(const std::string& file) : file_(file) {}

  Node node(const py::handle& value, const Node* source, const std::string& path) const {
    Node made{{}, {file_, 0, 0}};
    if (py::isinstance<py::dict>(value)) {
      made.value = table(py::reinterpret_borrow<py::dict>(value), source, path);
      if (source != nullptr && std::holds_alternative<Table>(source->value)) made.where = source->where;
      return made;
    }
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
      made.value = list(py::reinterpret_borrow<py::sequence>(value), source, path);
      if (source != nullptr && std::holds_alternative<List>(source->value)) made.where = source->where;
      return made;
    }
    if (py::hasattr(value, "tolist")) return node(value.attr("tolist")(), source, path);  // of numpy
    made.value = leaf(value, path);
    if (source != nullptr && made.value.index() == source->value.index() && describe(made) == describe(*source))
      made.where = source->where;
    return made;
  }

 private:
  decltype(Node::value) leaf(const py::handle& value, const std::string& path) const {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) {
      try {
        return value.cast<std::int64_t>();
      } catch (const py::cast_error&) {
        refuse(value, path);
      }
    }
    if (py::isinstance<py::float_>(value)) return value.cast<double>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::hasattr(value, "__fspath__")) return py::str(value.attr("__fspath__")()).cast<std::string>();
    refuse(value, path);
  }

  [[noreturn]] void refuse(const py::handle& value, const std::string& path) const {
    std::string shown = py::repr(value).cast<std::string>();
    constexpr std::size_t longest = 60;
    if (shown.size() > longest) shown = shown.substr(0, longest) + "...";
    throw CaseError({file_, 0, 0}, path, shown, "a number, a text, a list or a dict",
                    value.is_none() ? "To leave a key out, delete it." : "");
  }

  Table table(const py::dict& dict, const Node* source, const std::string& path) const {
    const auto* places = source != nullptr ? std::get_if<Table>(&source->value) : nullptr;
    Table made;
    for (const auto& [key, value] : dict) {
      if (!py::isinstance<py::str>(key)) refuse(key, path);
      const auto name = key.cast<std::string>();
      const Node* place = nullptr;
      Location where{file_, 0, 0};
      for (std::size_t i = 0; places != nullptr && i < places->members.size(); ++i) {
        if (places->members[i].key != name) continue;
        place = &places->members[i].value;
        where = places->members[i].where;
      }
      made.members.push_back({name, where, node(value, place, join(path, name))});
    }
    return made;
  }

  List list(const py::sequence& sequence, const Node* source, const std::string& path) const {
    const auto* places = source != nullptr ? std::get_if<List>(&source->value) : nullptr;
    List made;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
      const Node* place = places != nullptr && i < places->size() ? &(*places)[i] : nullptr;
      made.push_back(node(sequence[i], place, path + "[" + std::to_string(i) + "]"));
    }
    return made;
  }

  const std::string& file_;
};

}  // namespace

py::object to_python(const Node& node) {
  return std::visit(ToPython{}, node.value);
}

Node from_python(const py::handle& value, const Node* source, const std::string& file, const std::string& path) {
  return FromPython(file).node(value, source, path);
}

}  // namespace carom::python
