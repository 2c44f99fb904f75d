// Tables, parameters and fields as lists: counts fit, entries are complete, names are found, unknown
// names list the known ones.
#include <cmath>
#include <cstring>
#include <set>
#include <tuple>

#include "support/model.hpp"

namespace cleave::test {
namespace {

TEST(Tables, EntriesAreCompleteAndFoundByTheirName) {
  for (const int32_t table :
       {CLEAVE_TABLE_STATUS, CLEAVE_TABLE_MATERIAL, CLEAVE_TABLE_FORMULATION, CLEAVE_TABLE_GROUP}) {
    int64_t count = 0;
    ok(cleave_table_count(table, &count));
    ASSERT_GT(count, 0);
    std::set<std::string> names;
    for (int64_t k = 0; k < count; ++k) {
      cleave_table_entry e{};
      e.size = sizeof e;
      ok(cleave_table_get(table, k, &e));
      EXPECT_TRUE(names.insert(e.name).second) << e.name;
      EXPECT_GT(std::strlen(e.title), 0u) << e.name;
      EXPECT_NE(e.source, nullptr) << e.name;
      int32_t value = -1;
      ok(cleave_table_find(table, e.name, &value));
      EXPECT_EQ(value, e.value) << e.name;
      if (table == CLEAVE_TABLE_STATUS) {
        EXPECT_STREQ(cleave_status_text(e.value), e.title);
      }
    }
    cleave_table_entry e{};
    e.size = sizeof e;
    EXPECT_EQ(cleave_table_get(table, count, &e), CLEAVE_BAD_RANGE);
    EXPECT_EQ(cleave_table_get(table, -1, &e), CLEAVE_BAD_RANGE);
    int32_t value = 0;
    EXPECT_EQ(cleave_table_find(table, "no_such_name", &value), CLEAVE_UNKNOWN_NAME);
    for (const auto& name : names)
      EXPECT_NE(last_message().find(name), std::string::npos) << last_message();
  }
  int64_t count = 0;
  EXPECT_EQ(cleave_table_count(0, &count), CLEAVE_BAD_ARGUMENT);
  EXPECT_EQ(cleave_table_count(99, &count), CLEAVE_BAD_ARGUMENT);
}

TEST(Tables, EnumerationsAreTheTables) {
  int32_t value = 0;
  ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, "svk", &value));
  EXPECT_EQ(value, CLEAVE_MATERIAL_svk);
  ok(cleave_table_find(CLEAVE_TABLE_FORMULATION, "cbm", &value));
  EXPECT_EQ(value, CLEAVE_FORMULATION_cbm);
  ok(cleave_table_find(CLEAVE_TABLE_STATUS, "NOT_FINITE", &value));
  EXPECT_EQ(value, CLEAVE_NOT_FINITE);
}

TEST(Tables, ParametersOfEveryOwnerAreComplete) {
  for (const char* owner : {"svk", "fracture", "viscosity", "stabilisation"}) {
    int64_t count = 0;
    ok(cleave_parameter_count(owner, &count));
    ASSERT_GT(count, 0);
    for (int64_t k = 0; k < count; ++k) {
      cleave_parameter p{};
      p.size = sizeof p;
      ok(cleave_parameter_get(owner, k, &p));
      EXPECT_GT(std::strlen(p.name), 0u);
      EXPECT_GT(std::strlen(p.units), 0u) << p.name;
      EXPECT_GT(std::strlen(p.description), 0u) << p.name;
      EXPECT_LE(p.minimum, p.maximum) << p.name;
      if (p.type == CLEAVE_CHOICE) {
        EXPECT_NE(std::strstr(p.choices, p.default_choice), nullptr) << p.name;
      } else if (!p.required) {
        EXPECT_TRUE(p.default_value >= p.minimum && p.default_value <= p.maximum) << p.name;
      }
    }
    cleave_parameter p{};
    p.size = sizeof p;
    EXPECT_EQ(cleave_parameter_get(owner, count, &p), CLEAVE_BAD_RANGE);
  }
  int64_t count = 0;
  EXPECT_EQ(cleave_parameter_count("svkk", &count), CLEAVE_UNKNOWN_NAME);
  for (const char* known : {"'svkk'", "svk", "fracture", "viscosity", "stabilisation"})
    EXPECT_NE(last_message().find(known), std::string::npos) << last_message();
}

TEST(Tables, FieldsOfTheTableAreThoseOfABody) {
  int64_t count = 0;
  ok(cleave_field_table_count(&count));
  std::set<std::string> listed;
  std::set<std::pair<std::string, std::string>> owned;
  for (int64_t k = 0; k < count; ++k) {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_table_get(k, &f));
    EXPECT_TRUE(owned.insert({f.owner, f.name}).second) << f.name;
    listed.insert(f.name);
    EXPECT_EQ(f.count, 0);
    EXPECT_GT(f.components, 0);
    EXPECT_GT(std::strlen(f.description), 0u) << f.name;
    const bool computed =
        f.lifetime == CLEAVE_LIFETIME_CACHE || f.lifetime == CLEAVE_LIFETIME_DERIVED;
    EXPECT_EQ(std::strlen(f.rebuild) > 0, computed) << f.name;
  }
  cleave_field out_of_range{};
  out_of_range.size = sizeof out_of_range;
  EXPECT_EQ(cleave_field_table_get(count, &out_of_range), CLEAVE_BAD_RANGE);
  EXPECT_EQ(cleave_field_table_get(-1, &out_of_range), CLEAVE_BAD_RANGE);

  Model model;
  const SimplexMesh mesh = patch(3, 1, 1.0, 0.0, 1);
  model.add({}, mesh);
  model.setup();
  int64_t in_body = 0;
  ok(cleave_field_count(model, 0, &in_body));
  int64_t of_the_body = 0;
  for (const auto& [owner, name] : owned)
    of_the_body += owner == "core" || owner == "cbm" || owner == "svk";
  EXPECT_EQ(in_body, of_the_body);
  for (int64_t k = 0; k < in_body; ++k) {
    cleave_field f{}, g{};
    f.size = g.size = sizeof f;
    ok(cleave_field_get(model, 0, k, &f));
    ok(cleave_field_find(model, 0, f.name, &g));
    EXPECT_STREQ(f.name, g.name);
    EXPECT_STREQ(f.owner, g.owner) << f.name;
    EXPECT_EQ(std::tie(f.count, f.components, f.type, f.relation, f.lifetime, f.output),
              std::tie(g.count, g.components, g.type, g.relation, g.lifetime, g.output))
        << f.name;
    EXPECT_TRUE(listed.count(f.name)) << f.name;
    const int64_t expected[] = {0, 1, 8, 19, 6, 38};  // of a cube of six tetrahedra, by relation
    EXPECT_EQ(f.count, expected[f.relation]) << f.name;
  }
  uint64_t a = 0, b = 1;
  ok(cleave_field_table_fingerprint(&a));
  ok(cleave_field_table_fingerprint(&b));
  EXPECT_EQ(a, b);
  EXPECT_NE(a, 0u);
}

// A caller with an older, smaller struct is served; without a size, or with a larger one, refused.
TEST(Tables, StructsCarryTheirSize) {
  cleave_table_entry e{};
  for (const int64_t size : {int64_t{0}, int64_t{7}, int64_t{-8}, int64_t{sizeof e} + 8}) {
    e = {};
    e.size = size;
    e.value = 77;
    EXPECT_EQ(cleave_table_get(CLEAVE_TABLE_STATUS, 1, &e), CLEAVE_ABI_MISMATCH) << size;
    EXPECT_EQ(e.value, 77) << size;
    EXPECT_NE(last_message().find(std::to_string(size)), std::string::npos) << last_message();
  }
  e = {};
  e.size = offsetof(cleave_table_entry, title);
  ok(cleave_table_get(CLEAVE_TABLE_STATUS, 1, &e));
  EXPECT_STREQ(e.name, "NULL_ARGUMENT");
  EXPECT_EQ(e.title, nullptr);  // beyond the caller's struct: not touched
  EXPECT_EQ(e.size, static_cast<int64_t>(offsetof(cleave_table_entry, title)));
}

}  // namespace
}  // namespace cleave::test
