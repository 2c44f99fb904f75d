// The JSON that `cleave parse` prints, read back with a JSON parser.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/namelist.hpp"

namespace nml = cleave::io::namelist;
using Json = nlohmann::ordered_json;

namespace {

Json json(const std::string& text) {
  return Json::parse(nml::to_json(nml::parse(text, "deck.nml")));
}

TEST(NamelistJson, ShapeAndOrder) {
  const Json file = json("&run t_end = 1.5d-3\n/\n&Body Name='a' v(2:3) = 2*7,,T /\n&run /");
  EXPECT_EQ(file["file"], "deck.nml");
  ASSERT_EQ(file["groups"].size(), 3U);
  EXPECT_EQ(file["groups"][1]["name"], "body");
  EXPECT_EQ(file["groups"][1]["line"], 3);
  EXPECT_EQ(file["groups"][1]["column"], 1);
  EXPECT_TRUE(file["groups"][2]["assignments"].empty());
  const Json v = file["groups"][1]["assignments"][1];
  EXPECT_EQ(v, Json::parse(R"-({
    "name": "v(2:3)", "line": 3, "column": 16,
    "parts": [{"name": "v", "subscripts": [{"first": 2, "last": 3, "stride": 1}]}],
    "values": [7, 7, null, true],
    "types": ["integer", "integer", "null", "logical"]})-"));
}

TEST(NamelistJson, NamesOfManyParts) {
  const Json parts = json("&g a%b(3,::2)%c(:)(2:) = 1 /")["groups"][0]["assignments"][0]["parts"];
  EXPECT_EQ(parts, Json::parse(R"-([
    {"name": "a"},
    {"name": "b", "subscripts": [3, {"first": null, "last": null, "stride": 2}]},
    {"name": "c", "subscripts": [{"first": null, "last": null, "stride": 1}],
     "substring": {"first": 2, "last": null, "stride": 1}}])-"));
}

TEST(NamelistJson, NumbersKeepTypeAndValue) {
  const std::string text = nml::to_json(
      nml::parse("&g v = 1, 1., 9223372036854775807, 0.1, 5d-324, 1.7976931348623157e308 /", ""));
  const Json values = Json::parse(text)["groups"][0]["assignments"][0]["values"];
  EXPECT_TRUE(values[0].is_number_integer());
  EXPECT_TRUE(values[1].is_number_float());
  EXPECT_EQ(values[2].get<std::int64_t>(), INT64_MAX);
  EXPECT_EQ(values[3].get<double>(), 0.1);
  EXPECT_EQ(values[4].get<double>(), 5e-324);
  EXPECT_EQ(values[5].get<double>(), 1.7976931348623157e308);
}

TEST(NamelistJson, WhatJsonHasNoNumberFor) {
  const Json a = json("&g v = inf -inf nan (1,-inf) 'inf' /")["groups"][0]["assignments"][0];
  EXPECT_EQ(a["values"],
            Json::parse(R"-(["inf", "-inf", "nan", {"re": 1.0, "im": "-inf"}, "inf"])-"));
  EXPECT_EQ(a["types"], Json::parse(R"-(["real", "real", "real", "complex", "text"])-"));
}

TEST(NamelistJson, TextThatIsNotUtf8) {
  const Json a = json("&g s = 'caf\xE9' \"\x01\" /")["groups"][0]["assignments"][0];
  EXPECT_EQ(a["values"][0], "caf\xEF\xBF\xBD");
  EXPECT_EQ(a["values"][1], "\x01");
}

}  // namespace
