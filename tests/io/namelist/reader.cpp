// Reads namelist files with cleave::io into the variables that oracle.f90 declares, with Fortran's
// rules for subscripts, components and empty values, and prints them in the same way.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/namelist.hpp"
#include "io/namelist_section.hpp"

namespace nml = cleave::io::namelist;

namespace {

struct Mismatch {
  std::string what;
};

enum class Type { integer, real, logical, text, complex, derived };

struct Variable {
  std::string name;
  Type type = Type::integer;
  std::vector<nml::Bounds> bounds;             // empty: scalar
  std::vector<nml::Scalar> elements;           // in the order of memory
  std::size_t length = 0;                      // of texts
  std::vector<std::vector<Variable>> derived;  // components of each element
};

std::size_t element_count(const std::vector<nml::Bounds>& bounds) {
  std::int64_t count = 1;
  for (const nml::Bounds& b : bounds) count *= b.count;
  return static_cast<std::size_t>(count);
}

std::string padded(std::string text, std::size_t length) {
  text.resize(length, ' ');
  return text;
}

Variable variable(std::string name, Type type, std::vector<nml::Bounds> bounds,
                  const nml::Scalar& initial, std::size_t length = 0) {
  Variable v{std::move(name), type, std::move(bounds), {}, length, {}};
  v.elements.assign(element_count(v.bounds), initial);
  return v;
}

Variable derived(std::string name, std::vector<nml::Bounds> bounds,
                 const std::vector<Variable>& components) {
  Variable v{std::move(name), Type::derived, std::move(bounds), {}, 0, {}};
  v.derived.assign(element_count(v.bounds), components);
  return v;
}

constexpr std::int64_t kUnset = -7;

Variable integers(std::string name, std::vector<nml::Bounds> bounds) {
  return variable(std::move(name), Type::integer, std::move(bounds), kUnset);
}
Variable reals(std::string name, std::vector<nml::Bounds> bounds) {
  return variable(std::move(name), Type::real, std::move(bounds), double{kUnset});
}
Variable texts(std::string name, std::size_t length, std::vector<nml::Bounds> bounds) {
  return variable(std::move(name), Type::text, std::move(bounds), padded("initial", length),
                  length);
}
Variable logicals(std::string name, std::vector<nml::Bounds> bounds, bool initial) {
  return variable(std::move(name), Type::logical, std::move(bounds), initial);
}
Variable complexes(std::string name, std::vector<nml::Bounds> bounds) {
  return variable(std::move(name), Type::complex, std::move(bounds), nml::Complex{kUnset, kUnset});
}

std::vector<Variable> group_g() {
  const std::vector<Variable> inner = {integers("n", {}), reals("w", {})};
  const std::vector<Variable> outer = {integers("a", {}), reals("b", {{1, 2}}),
                                       derived("c", {{1, 3}}, inner), texts("nm", 8, {})};
  Variable lv = logicals("lv", {{1, 4}}, false);
  lv.elements[1] = lv.elements[3] = true;
  return {integers("i", {}),
          integers("j", {}),
          integers("iv", {{1, 6}}),
          integers("m", {{1, 2}, {1, 3}}),
          integers("neg", {{-2, 5}}),
          integers("i8", {}),
          reals("r", {}),
          reals("rv", {{1, 6}}),
          reals("rm", {{1, 2}, {1, 2}, {1, 2}}),
          logicals("l", {}, false),
          logicals("t", {}, false),
          logicals("f", {}, true),
          lv,
          texts("s", 12, {}),
          texts("sv", 12, {{1, 3}}),
          complexes("z", {}),
          complexes("zv", {{1, 3}}),
          derived("d", {}, outer),
          derived("dv", {{1, 2}}, outer)};
}

std::vector<Variable> group_h() { return {integers("n", {}), reals("x", {{1, 3}})}; }

// A place for one value: an element of a variable, or some characters of it.
struct Target {
  Variable* variable;
  std::size_t element;
  std::size_t first, count;  // characters of a text
};

Variable& find(std::vector<Variable>& variables, const std::string& name) {
  for (Variable& v : variables) {
    if (v.name == name) return v;
  }
  throw Mismatch{"no variable " + name};
}

void add_all(Variable& v, std::size_t element, std::vector<Target>& targets) {
  if (v.type != Type::derived) {
    targets.push_back({&v, element, 0, v.length});
    return;
  }
  for (Variable& component : v.derived[element]) {
    for (std::size_t e = 0; e < element_count(component.bounds); ++e)
      add_all(component, e, targets);
  }
}

void resolve(std::vector<Variable>& scope, const std::vector<nml::NamePart>& name, std::size_t part,
             std::vector<Target>& targets) {
  Variable& v = find(scope, name[part].name);
  std::vector<nml::Subscript> subscripts = name[part].subscripts;
  std::vector<nml::Subscript> substring = name[part].substring;
  if (v.bounds.empty() && substring.empty()) substring.swap(subscripts);  // s(2:3)

  const bool last = part + 1 == name.size();
  const nml::Section section(subscripts, v.bounds);
  bool single = !subscripts.empty();
  for (const nml::Subscript& s : subscripts) single = single && !s.is_range;
  // A single element of derived type, or with components, is that element only.
  const std::int64_t size = single && (!last || v.type == Type::derived) ? 1 : section.size();
  for (std::int64_t k = 0; k < size; ++k) {
    const auto element = static_cast<std::size_t>(section.element(k));
    if (!last) {
      if (v.type != Type::derived) throw Mismatch{v.name + " has no components"};
      resolve(v.derived[element], name, part + 1, targets);
      continue;
    }
    add_all(v, element, targets);
    if (!substring.empty()) {
      const nml::Subscript& range = substring.front();
      const std::int64_t first = range.has_first ? range.first : 1;
      const std::int64_t end = range.has_last ? range.last : static_cast<std::int64_t>(v.length);
      if (first < 1 || end < first || end > static_cast<std::int64_t>(v.length)) {
        throw Mismatch{"substring of " + v.name};
      }
      targets.back().first = static_cast<std::size_t>(first - 1);
      targets.back().count = static_cast<std::size_t>(end - first + 1);
    }
  }
}

void store(const Target& target, const nml::Value& value) {
  nml::Scalar& element = target.variable->elements[target.element];
  const std::string what = target.variable->name + " = " + value.text;
  switch (target.variable->type) {
    case Type::integer:
      if (!std::holds_alternative<std::int64_t>(value.scalar)) throw Mismatch{what};
      element = value.scalar;
      return;
    case Type::real: {
      double real = 0;
      if (!nml::as_real(value, real)) throw Mismatch{what};
      element = real;
      return;
    }
    case Type::logical:
      if (!std::holds_alternative<bool>(value.scalar)) throw Mismatch{what};
      element = value.scalar;
      return;
    case Type::complex:
      if (!std::holds_alternative<nml::Complex>(value.scalar)) throw Mismatch{what};
      element = value.scalar;
      return;
    case Type::text: {
      const auto* text = std::get_if<std::string>(&value.scalar);
      if (text == nullptr) throw Mismatch{what};
      std::get<std::string>(element).replace(target.first, target.count,
                                             padded(*text, target.count));
      return;
    }
    case Type::derived:
      throw Mismatch{what};
  }
}

void apply(std::vector<Variable>& scope, const nml::Assignment& assignment) {
  std::vector<Target> targets;
  resolve(scope, assignment.name, 0, targets);
  for (std::size_t k = 0; k < assignment.values.size(); ++k) {
    const nml::Value& value = assignment.values[k];
    if (std::holds_alternative<nml::Null>(value.scalar)) continue;
    if (k >= targets.size()) throw Mismatch{"too many values for " + assignment.full_name()};
    store(targets[k], value);
  }
}

std::string bits(double number) {
  char text[17];
  const std::uint64_t word =
      std::isnan(number) ? 0x7FF8000000000000U : std::bit_cast<std::uint64_t>(number);
  std::snprintf(text, sizeof text, "%016llX", static_cast<unsigned long long>(word));
  return text;
}

struct Write {
  void operator()(nml::Null) const { std::cout << " null"; }
  void operator()(std::int64_t n) const { std::cout << ' ' << n; }
  void operator()(double x) const { std::cout << ' ' << bits(x); }
  void operator()(bool b) const { std::cout << (b ? " T" : " F"); }
  void operator()(const std::string& text) const { std::cout << " [" << text << ']'; }
  void operator()(const nml::Complex& z) const {
    std::cout << ' ' << bits(z.re) << ' ' << bits(z.im);
  }
};

void put(const std::string& name, const std::vector<nml::Scalar>& elements) {
  std::cout << name;
  for (const nml::Scalar& element : elements) std::visit(Write{}, element);
  std::cout << "\n";
}

void put(const std::string& prefix, const Variable& v);

// Components of a derived array, each as one list over the elements: d%c%n.
void put_columns(const std::string& prefix, const Variable& v) {
  for (std::size_t k = 0; k < v.derived.front().size(); ++k) {
    std::vector<nml::Scalar> column;
    for (const std::vector<Variable>& element : v.derived) {
      column.insert(column.end(), element[k].elements.begin(), element[k].elements.end());
    }
    put(prefix + "%" + v.derived.front()[k].name, column);
  }
}

void put(const std::string& prefix, const Variable& v) {
  const std::string name = prefix + v.name;
  if (v.type != Type::derived) {
    put(name, v.elements);
  } else if (!prefix.empty()) {
    put_columns(name, v);
  } else {
    for (std::size_t e = 0; e < v.derived.size(); ++e) {
      const std::string element =
          v.bounds.empty() ? name : name + "(" + std::to_string(e + 1) + ")";
      for (const Variable& component : v.derived[e]) put(element + "%", component);
    }
  }
}

void put_groups(const nml::File& file, const std::string& name) {
  for (const nml::Group& group : file.groups) {
    if (group.name != name) continue;
    std::vector<Variable> scope = name == "g" ? group_g() : group_h();
    for (const nml::Assignment& assignment : group.assignments) apply(scope, assignment);
    std::cout << "group " << name << "\n";
    for (const Variable& v : scope) put("", v);
  }
}

}  // namespace

int main() {
  for (std::string path; std::getline(std::cin, path);) {
    std::cout << "file " << path << "\n";
    try {
      const nml::File file = nml::read(path);
      put_groups(file, "g");
      put_groups(file, "h");
    } catch (const cleave::io::Error& error) {
      std::cout << "refused " << error.what() << "\n";
    } catch (const Mismatch& mismatch) {
      std::cout << "refused " << mismatch.what << "\n";
    }
  }
}
