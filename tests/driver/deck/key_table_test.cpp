#include "deck/key_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "deck/kernel_tables.hpp"

namespace cleave::driver {
namespace {

TEST(KeyTable, NamesAreUniqueInAnyCase) {
  std::set<std::string> groups;
  for (const GroupSpec& group : key_table().groups()) {
    EXPECT_TRUE(groups.insert(group.name).second) << group.name;
    for (const KeyVariant& variant : group.variants) {
      const auto keys = group.keys_of(variant.choice);
      for (std::size_t i = 0; i < keys.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_FALSE(same_name(keys[i]->name, keys[j]->name)) << group.name << keys[i]->name;
    }
  }
}

bool holds(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

struct DefaultIsAllowed {
  const KeySpec& key;
  bool operator()(double v) const { return std::isnan(v) || key.allowed.contains(v); }
  bool operator()(std::int64_t v) const { return key.allowed.contains(static_cast<double>(v)); }
  bool operator()(bool) const { return true; }
  bool operator()(const std::string& v) const {
    return key.type == KeyType::text || holds(key.allowed.choices, v);
  }
  template <class T>
  bool operator()(const std::vector<T>& list) const {
    const auto& counts = key.allowed.counts;
    const auto count = static_cast<std::int64_t>(list.size());
    return counts.empty() || std::find(counts.begin(), counts.end(), count) != counts.end();
  }
};

// Every default must be what the key itself allows, or a resolved deck would be refused.
TEST(KeyTable, DefaultsAreAllowed) {
  for (const GroupSpec& group : key_table().groups()) {
    for (const KeySpec& key : group.keys) {
      const bool fine = key.required || std::visit(DefaultIsAllowed{key}, key.default_value);
      EXPECT_TRUE(fine) << group.name << '.' << key.name;
    }
  }
}

TEST(KeyTable, EveryKeyIsDescribed) {
  for (const GroupSpec& group : key_table().groups()) {
    EXPECT_FALSE(group.description.empty()) << group.name;
    for (const KeySpec& key : group.keys)
      EXPECT_FALSE(key.description.empty()) << group.name << '.' << key.name;
  }
}

TEST(KeyTable, ReferencesPointToNamesThatExist) {
  for (const GroupSpec& group : key_table().groups()) {
    for (const KeySpec& key : group.keys) {
      const std::string& kind = key.allowed.refers;
      const bool known = kind.empty() || !key_table().groups_naming(kind).empty();
      EXPECT_TRUE(known) << group.name << '.' << key.name;
    }
  }
  EXPECT_EQ(key_table().groups_naming("mesh"), "&mesh or &lattice or &points");
}

TEST(KeyTable, LawsBringTheirPropertiesIntoMaterial) {
  const GroupSpec* material = key_table().find("material");
  ASSERT_NE(material, nullptr);
  EXPECT_EQ(material->selector, "law");
  const auto laws = table_names(CLEAVE_TABLE_MATERIAL);
  ASSERT_EQ(material->variants.size(), laws.size());
  for (std::size_t i = 0; i < laws.size(); ++i) {
    EXPECT_EQ(material->variants[i].choice, laws[i]);
    const auto parameters = table_parameters(laws[i]);
    ASSERT_EQ(material->variants[i].keys.size(), parameters.size());
    for (std::size_t k = 0; k < parameters.size(); ++k)
      EXPECT_EQ(material->variants[i].keys[k].name, parameters[k].name);
  }
}

TEST(KeyTable, ParameterGroupsComeFromTheKernels) {
  for (const std::string& name : table_names(CLEAVE_TABLE_GROUP)) {
    const GroupSpec* group = key_table().find(name);
    ASSERT_NE(group, nullptr) << name;
    EXPECT_TRUE(group->parameter_group);
    ASSERT_EQ(group->keys.size(), table_parameters(name).size() + 1);
    EXPECT_EQ(group->keys.front().name, "body");
    EXPECT_TRUE(group->keys.back().parameter);
  }
}

TEST(KeyTable, RangeOfPoissonsRatioIsOpen) {
  const KeySpec* nu = key_table().find("material")->find("NU");
  ASSERT_NE(nu, nullptr);
  EXPECT_EQ(allowed_text(nu->allowed), "> -1 and < 0.5");
  EXPECT_FALSE(nu->allowed.contains(0.5));
  EXPECT_TRUE(nu->allowed.contains(std::nextafter(0.5, 0.0)));
  EXPECT_FALSE(nu->allowed.contains(-1));
}

TEST(KeyRange, ReadsBounds) {
  const Allowed open = parse_allowed(KeyType::real, "> 0, <= 1");
  EXPECT_FALSE(open.contains(0));
  EXPECT_TRUE(open.contains(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(open.contains(1));
  EXPECT_FALSE(open.contains(std::nextafter(1.0, 2.0)));
  EXPECT_EQ(allowed_text(open), "> 0 and <= 1");
  const Allowed any = parse_allowed(KeyType::real, "");
  EXPECT_TRUE(any.contains(-1e300));
  EXPECT_EQ(allowed_text(any), "");
  EXPECT_EQ(allowed_text(parse_allowed(KeyType::reals, "0|2|3")), "0, 2 or 3 entries");
  EXPECT_THROW(parse_allowed(KeyType::real, "about 3"), std::logic_error);
}

TEST(ValueText, IsNamelistSyntax) {
  EXPECT_EQ(value_text(1.0), "1.0");
  EXPECT_EQ(value_text(1e-6), "1e-06");
  EXPECT_EQ(value_text(std::int64_t{-3}), "-3");
  EXPECT_EQ(value_text(true), ".true.");
  EXPECT_EQ(value_text(std::string("it's")), "'it''s'");
  EXPECT_EQ(value_text(std::vector<double>{1, 0.5}), "1.0, 0.5");
  EXPECT_EQ(value_text(std::vector<std::string>{"a", "b"}), "'a', 'b'");
  EXPECT_EQ(value_text(std::nan("")), "");
}

}  // namespace
}  // namespace cleave::driver
