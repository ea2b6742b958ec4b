// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf_record.h"

#include <charconv>
#include <cmath>

#include "calibration/whole_file.h"

namespace insitu {
namespace {

constexpr double kLargestNumber = 1e12;
constexpr int kLowestCode = -5;
constexpr int kHighestCode = 1071;

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Text for a message: short, and printable whatever the file holds.
std::string Quoted(std::string_view text) {
  constexpr size_t kLongest = 40;
  std::string quoted = "\"";
  for (const char c : text.substr(0, kLongest)) quoted += (c >= ' ' && c <= '~') ? c : '?';
  return quoted + (text.size() > kLongest ? "...\"" : "\"");
}

template <typename T>
std::optional<T> Parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// The lines of a text, one after the other, blanks trimmed.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  int number() const { return number_; }  // of the line read last

  std::optional<std::string_view> Next() {
    if (rest_.empty()) return std::nullopt;
    const size_t length = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    ++number_;
    return Trimmed(line);
  }

 private:
  std::string_view rest_;
  int number_ = 0;
};

void RefuseOtherFormats(const std::filesystem::path& path, std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF")) {
    throw InputError(path, "is a binary DXF, expected an ASCII DXF: save it as such");
  }
  if (text.starts_with("AC10")) {
    throw InputError(path, "is a DWG drawing, expected an ASCII DXF: save it as such");
  }
}

}  // namespace

const DxfTag* DxfRecord::Find(int code) const {
  for (const DxfTag& tag : tags_) {
    if (tag.code == code) return &tag;
  }
  return nullptr;
}

std::string DxfRecord::Name(int code, const std::string& if_absent) const {
  const DxfTag* tag = Find(code);
  return tag ? Utf8FromDxf(tag->value) : if_absent;
}

int DxfRecord::Integer(int code, int if_absent) const {
  const DxfTag* tag = Find(code);
  return tag ? IntegerOf(*tag) : if_absent;
}

double DxfRecord::Number(int code, double if_absent) const {
  const DxfTag* tag = Find(code);
  return tag ? NumberOf(*tag) : if_absent;
}

std::optional<Eigen::Vector3d> DxfRecord::FindPoint(int code) const {
  const DxfTag* x = Find(code);
  if (!x) return std::nullopt;
  const DxfTag* y = Find(code + 10);
  if (!y) {
    throw ErrorAt(*x, "group " + std::to_string(code) + " (x) has no group " +
                          std::to_string(code + 10) + " (y) beside it");
  }
  return Eigen::Vector3d(NumberOf(*x), NumberOf(*y), Number(code + 20, 0));
}

Eigen::Vector3d DxfRecord::Point(int code) const {
  const std::optional<Eigen::Vector3d> point = FindPoint(code);
  if (!point) {
    throw Error(std::string(kind()) + " has no point, expected one at group " +
                std::to_string(code));
  }
  return *point;
}

int DxfRecord::IntegerOf(const DxfTag& tag) const {
  const std::optional<int> value = Parsed<int>(tag.value);
  if (!value) {
    throw ErrorAt(
        tag, Quoted(tag.value) + ", expected an integer for group " + std::to_string(tag.code));
  }
  return *value;
}

double DxfRecord::NumberOf(const DxfTag& tag) const {
  const std::optional<double> value = Parsed<double>(tag.value);
  if (!value || !(std::abs(*value) <= kLargestNumber)) {
    throw ErrorAt(tag, Quoted(tag.value) + ", expected a number of at most 1e12 for group " +
                           std::to_string(tag.code));
  }
  return *value;
}

InputError DxfRecord::Error(const std::string& message) const {
  return ErrorAt(tags_.front(), message);
}

InputError DxfRecord::ErrorAt(const DxfTag& tag, const std::string& message) const {
  return InputError(*file_, tag.line, message);
}

DxfFile::DxfFile(const std::filesystem::path& path) : path_(path), text_(ReadWhole(path)) {
  RefuseOtherFormats(path_, text_);
  SplitIntoTags();
  GatherRecords();
}

void DxfFile::SplitIntoTags() {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view text = text_;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Lines lines(text);
  for (;;) {
    const auto code_line = lines.Next();
    const std::optional<int> code = code_line ? Parsed<int>(*code_line) : std::nullopt;
    if (code_line && (!code || *code < kLowestCode || *code > kHighestCode)) {
      throw InputError(path_, lines.number(),
                       Quoted(*code_line) + ", expected a DXF group code (an integer)");
    }
    const auto value = lines.Next();
    if (!code_line || !value) {
      throw InputError(path_, lines.number(),
                       "the drawing ends here, expected its EOF: it is cut short");
    }
    if (*code == 999) continue;
    tags_.push_back({*code, *value, lines.number()});
    if (*code == 0 && *value == "EOF") return;
  }
}

void DxfFile::GatherRecords() {
  if (tags_.front().code != 0) {
    throw InputError(path_, tags_.front().line - 1,
                     "a drawing begins with group code 0 (SECTION), not with " +
                         std::to_string(tags_.front().code));
  }
  const std::span<const DxfTag> tags = tags_;
  size_t first = 0;
  for (size_t i = 1; i <= tags.size(); ++i) {
    if (i < tags.size() && tags[i].code != 0) continue;
    records_.emplace_back(path_, tags.subspan(first, i - first));
    first = i;
  }
}

}  // namespace insitu
