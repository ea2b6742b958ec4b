// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/json_file.h"

#include <numbers>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

constexpr char kText[] = R"({
  "name": "gallery",
  "count": 3,
  "flag": true,
  "nothing": null,
  "samples": [
    {"pixel": [1, 2.5]},
    {"pixel": [1, "two"]}
  ],
  "north": [0.1, 0.2, 0.3]
})";

class JsonFile : public testing::Test {
 protected:
  JsonNode Load(const std::string& text) { return JsonNode::Load(folder_.Write("a.json", text)); }
  std::string At(int line) {
    return (folder_.path() / "a.json").string() + ":" + std::to_string(line) + ": ";
  }
  ScratchFolder folder_;
};

TEST_F(JsonFile, ReadsEveryKindOfValue) {
  const JsonNode root = Load(kText);
  EXPECT_EQ(root.At("name").Text(), "gallery");
  EXPECT_EQ(root.At("count").Integer(), 3);
  EXPECT_EQ(root.At("count").Number(), 3);
  EXPECT_TRUE(root.At("flag").Boolean());
  EXPECT_FALSE(root.Find("nothing"));
  EXPECT_FALSE(root.Find("absent"));
  EXPECT_EQ(root.At("north").Vector3(), Eigen::Vector3d(0.1, 0.2, 0.3));
  const std::vector<double> expected = {1, 2.5};
  EXPECT_EQ(root.At("samples").Items()[0].At("pixel").Numbers(), expected);
  EXPECT_EQ(root.Members().front().first, "count");
  EXPECT_EQ(root.Members().size(), 6u);
}

TEST_F(JsonFile, WrongTypesNameLineAndKey) {
  const JsonNode root = Load(kText);
  EXPECT_EQ(root.At("samples").Items()[1].line(), 8);
  EXPECT_EQ(InputErrorOf([&] { root.At("samples").Items()[1].At("pixel").Numbers(); }),
            At(8) + "\"samples[1].pixel[1]\" is a text, expected a number");
  EXPECT_EQ(InputErrorOf([&] { root.At("absent"); }), At(1) + "\"absent\" is missing");
  EXPECT_EQ(InputErrorOf([&] { root.At("nothing"); }), At(1) + "\"nothing\" is missing");
  EXPECT_EQ(InputErrorOf([&] { root.At("samples").Items()[0].At("x"); }),
            At(7) + "\"samples[0]\" \"x\" is missing");
  EXPECT_EQ(InputErrorOf([&] { root.At("name").Number(); }),
            At(2) + "\"name\" is a text, expected a number");
  EXPECT_EQ(InputErrorOf([&] { root.At("flag").Integer(); }),
            At(4) + "\"flag\" is a boolean, expected a whole number");
  EXPECT_EQ(InputErrorOf([&] { root.At("count").Text(); }),
            At(3) + "\"count\" is a number, expected a text");
  EXPECT_EQ(InputErrorOf([&] { root.At("count").Boolean(); }),
            At(3) + "\"count\" is a number, expected true or false");
  EXPECT_EQ(InputErrorOf([&] { root.At("name").Items(); }),
            At(2) + "\"name\" is a text, expected an array");
  EXPECT_EQ(InputErrorOf([&] { root.At("name").Members(); }),
            At(2) + "\"name\" is a text, expected an object");
  EXPECT_EQ(InputErrorOf([&] { root.At("samples").Items()[0].At("pixel").Vector3(); }),
            At(7) + "\"samples[0].pixel\" has 2 numbers, expected 3");
}

TEST_F(JsonFile, IntegersAreWhole) {
  const JsonNode root = Load("{\"a\": 2.5,\n\"b\": 1e20}");
  EXPECT_EQ(InputErrorOf([&] { root.At("a").Integer(); }),
            At(1) + "\"a\" is 2.5, expected a whole number");
  EXPECT_THROW(root.At("b").Integer(), InputError);
}

TEST_F(JsonFile, SyntaxErrorsNameTheLine) {
  const auto message = [&](const std::string& text) { return InputErrorOf([&] { Load(text); }); };
  EXPECT_EQ(message("{\n\"a\": NaN}").find(At(2) + "not valid JSON: "), 0u);
  EXPECT_EQ(message("{\n\"a\": 1,\n\"a\": 2}").find(At(3) + "not valid JSON: Duplicate key"), 0u);
  EXPECT_EQ(message("{\"a\": 1}\ntrailing").find(At(2) + "not valid JSON: "), 0u);
  EXPECT_EQ(message("{\"a\": [1,\n2").find(At(2) + "not valid JSON: "), 0u);
  EXPECT_EQ(message("{\"a\":\n 1e999}").find(At(2)), 0u);
  EXPECT_NE(message("").find("not valid JSON"), std::string::npos);
  EXPECT_NE(message(std::string(5000, '[')).find("not valid JSON"), std::string::npos);
}

TEST_F(JsonFile, MissingFile) {
  EXPECT_EQ(InputErrorOf([] { JsonNode::Load("/nowhere/a.json"); }),
            "/nowhere/a.json: cannot be read");
}

TEST_F(JsonFile, WritesSeventeenDigits) {
  const auto path = folder_.path() / "deep" / "b.json";
  Json::Value value;
  value["vector"] = ToJson(Eigen::VectorXd(Eigen::Vector3d(2600512.123456789, 0.1, -1e-300)));
  value["matrix"] =
      ToJson(Eigen::MatrixXd(Eigen::Matrix<double, 2, 3>{{1, 2, std::numbers::pi}, {4, 5, 6}}));
  WriteJson(path, value);
  const JsonNode root = JsonNode::Load(path);
  EXPECT_EQ(root.At("vector").Vector3(), Eigen::Vector3d(2600512.123456789, 0.1, -1e-300));
  ASSERT_EQ(root.At("matrix").Items().size(), 2u);
  EXPECT_EQ(root.At("matrix").Items()[0].Vector3(), Eigen::Vector3d(1, 2, std::numbers::pi));
  WriteJson(folder_.path() / "c.json", value);
  EXPECT_EQ(ReadWhole(path), ReadWhole(folder_.path() / "c.json"));
}

}  // namespace
}  // namespace insitu
