// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/json_file.h"

#include <json/reader.h>
#include <json/writer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "calibration/files/error_at.h"
#include "calibration/files/whole_file.h"

namespace insitu {

// jsoncpp is chosen because its values remember their offset in the text: that gives the lines.
struct JsonNode::Document {
  std::filesystem::path path;
  std::string text;
  Json::Value root;
};

namespace {

// jsoncpp reports "* Line 3, Column 5\n  message\n..."; the first of them becomes ours.
SaidError SyntaxError(const std::filesystem::path& path, const std::string& report) {
  std::istringstream stream(report);
  std::string position, message;
  std::getline(stream, position);
  std::getline(stream >> std::ws, message);
  int line = 0;
  std::sscanf(position.c_str(), "* Line %d", &line);
  return ErrorAt({path, line},
                 Sentence("jsonInvalid", "not valid JSON: {why}", {{"why", message}}));
}

Sentence TypeOf(const Json::Value& value) {
  switch (value.type()) {
    case Json::nullValue:
      return Sentence("jsonNull", "null");
    case Json::booleanValue:
      return Sentence("jsonBoolean", "a boolean");
    case Json::stringValue:
      return Sentence("jsonText", "a text");
    case Json::arrayValue:
      return Sentence("jsonArray", "an array");
    case Json::objectValue:
      return Sentence("jsonObject", "an object");
    default:
      return Sentence("jsonNumber", "a number");
  }
}

// What a value is and should be, thrown from its node.
SaidError Fault(const JsonNode& node, const Sentence& what) {
  return {node.Error(what.text()), {node.path(), node.line()}, what};
}

Sentence NumbersExpected(size_t count, Eigen::Index expected) {
  return Sentence("jsonNumbers", "has {count} numbers, expected {expected}",
                  {{"count", int(count)}, {"expected", int(expected)}});
}

SaidError OtherType(const JsonNode& node, const Json::Value& value, const Sentence& expected) {
  return Fault(node, Sentence("jsonOther", "is {what}, expected {expected}",
                              {{"what", TypeOf(value).ToJson()}, {"expected", expected.ToJson()}}));
}

}  // namespace

JsonNode JsonNode::Load(const std::filesystem::path& path) {
  auto document = std::make_shared<Document>();
  document->path = path;
  document->text = ReadWhole(path);
  document->root = ParseJson(path, document->text);
  const Json::Value* root = &document->root;
  return JsonNode(std::move(document), root, "");
}

JsonNode JsonNode::At(const std::string& key) const {
  std::optional<JsonNode> node = Find(key);
  if (!node) throw Fault(*this, Sentence("jsonMissing", "\"{key}\" is missing", {{"key", key}}));
  return *std::move(node);
}

std::optional<JsonNode> JsonNode::Find(const std::string& key) const {
  if (!value_->isObject()) {
    throw OtherType(*this, *value_,
                    Sentence("jsonObjectWith", "an object with \"{key}\"", {{"key", key}}));
  }
  const Json::Value* found = value_->find(key.data(), key.data() + key.size());
  if (!found || found->isNull()) return std::nullopt;
  return JsonNode(document_, found, place_.empty() ? key : place_ + "." + key);
}

std::vector<JsonNode> JsonNode::Items() const {
  if (!value_->isArray()) throw OtherType(*this, *value_, Sentence("jsonArray", "an array"));
  std::vector<JsonNode> items;
  for (Json::ArrayIndex i = 0; i < value_->size(); ++i) {
    items.push_back(
        JsonNode(document_, &(*value_)[i], place_ + "[" + std::to_string(items.size()) + "]"));
  }
  return items;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::Members() const {
  if (!value_->isObject()) throw OtherType(*this, *value_, Sentence("jsonObject", "an object"));
  std::vector<std::pair<std::string, JsonNode>> members;
  for (const std::string& key : value_->getMemberNames()) {
    if (IsRemarkKey(key)) continue;
    const std::string place = place_.empty() ? key : place_ + "." + key;
    members.emplace_back(key, JsonNode(document_, &(*value_)[key], place));
  }
  return members;
}

double JsonNode::Number() const {
  if (!value_->isNumeric()) throw OtherType(*this, *value_, Sentence("jsonNumber", "a number"));
  const double number = value_->asDouble();
  if (!std::isfinite(number)) {
    throw Fault(*this, Sentence("jsonNotFinite", "is not finite, expected a finite number"));
  }
  return number;
}

int JsonNode::Integer() const {
  const Sentence whole("jsonWhole", "a whole number");
  if (!value_->isNumeric()) throw OtherType(*this, *value_, whole);
  if (!value_->isInt()) {
    throw Fault(*this, Sentence("jsonOther", "is {what}, expected {expected}",
                                {{"what", value_->asString()}, {"expected", whole.ToJson()}}));
  }
  return value_->asInt();
}

bool JsonNode::Boolean() const {
  if (!value_->isBool()) throw OtherType(*this, *value_, Sentence("jsonBool", "true or false"));
  return value_->asBool();
}

std::string JsonNode::Text() const {
  if (!value_->isString()) throw OtherType(*this, *value_, Sentence("jsonText", "a text"));
  return value_->asString();
}

std::vector<double> JsonNode::Numbers() const {
  std::vector<double> numbers;
  for (const JsonNode& item : Items()) numbers.push_back(item.Number());
  return numbers;
}

std::vector<std::string> JsonNode::Texts() const {
  std::vector<std::string> texts;
  for (const JsonNode& item : Items()) texts.push_back(item.Text());
  return texts;
}

Eigen::Vector3d JsonNode::Vector3() const {
  const std::vector<double> numbers = Numbers();
  if (numbers.size() != 3) {
    throw Fault(*this, NumbersExpected(numbers.size(), 3));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::MatrixXd JsonNode::Matrix() const {
  const std::vector<JsonNode> rows = Items();
  Eigen::MatrixXd matrix(rows.size(), rows.empty() ? 0 : rows.front().Items().size());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const std::vector<double> row = rows[i].Numbers();
    if (static_cast<Eigen::Index>(row.size()) != matrix.cols()) {
      throw Fault(rows[i], NumbersExpected(row.size(), matrix.cols()));
    }
    matrix.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), matrix.cols());
  }
  return matrix;
}

bool JsonNode::IsNull() const { return value_->isNull(); }

InputError JsonNode::Error(const std::string& message) const {
  return InputError(path(), line(), place_.empty() ? message : "\"" + place_ + "\" " + message);
}

const std::filesystem::path& JsonNode::path() const { return document_->path; }

int JsonNode::line() const {
  const auto begin = document_->text.begin();
  return 1 + static_cast<int>(std::count(begin, begin + value_->getOffsetStart(), '\n'));
}

Json::Value ToJson(const Eigen::VectorXd& vector) {
  Json::Value array(Json::arrayValue);
  for (const double element : vector) array.append(element);
  return array;
}

Json::Value ToJson(const Eigen::Vector3d& vector) { return ToJson(Eigen::VectorXd(vector)); }

Json::Value ToJson(const Eigen::MatrixXd& matrix) {
  Json::Value rows(Json::arrayValue);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.append(ToJson(Eigen::VectorXd(matrix.row(i))));
  }
  return rows;
}

Json::Value ReadJson(const std::filesystem::path& path) { return ParseJson(path, ReadWhole(path)); }

Json::Value ParseJson(const std::filesystem::path& path, const std::string& text) {
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);  // no doubled keys, NaN, trailing text
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  Json::Value root;
  std::string report;
  try {
    if (reader->parse(text.data(), text.data() + text.size(), &root, &report)) return root;
  } catch (const Json::Exception& exception) {  // nested too deeply
    throw ErrorAt({path},
                  Sentence("jsonInvalid", "not valid JSON: {why}", {{"why", exception.what()}}));
  }
  throw SyntaxError(path, report);
}

void WriteJson(const std::filesystem::path& path, const Json::Value& value) {
  Json::StreamWriterBuilder builder;
  builder.settings_["indentation"] = " ";
  builder.settings_["precision"] = 17;
  WriteWhole(path, Json::writeString(builder, value) + "\n");
}

}  // namespace insitu
