// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_reader.h"

#include <charconv>
#include <cstring>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr size_t kBufferSize = 1 << 20;
constexpr size_t kLongestLine = 1 << 20;
constexpr std::string_view kBinarySentinel("AutoCAD Binary DXF\r\n\x1a\0", 22);
constexpr int kLowestCode = -5, kLowestTextCode = -32768;
constexpr int kHighestCode = 1071;       // of a binary drawing, where another shows damage
constexpr int kHighestTextCode = 32767;  // programs add private ones
constexpr int kComment = 999;

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<int> GroupCode(std::string_view line) {
  if (line.starts_with('+')) line.remove_prefix(1);
  int code = 0;
  const auto [end, status] = std::from_chars(line.data(), line.data() + line.size(), code);
  const bool valid = status == std::errc() && end == line.data() + line.size() &&
                     code >= kLowestTextCode && code <= kHighestTextCode;
  return valid ? std::optional(code) : std::nullopt;
}

// How a value is stored in a binary file, by group code (DXF reference of AutoCAD).
enum class Storage { kText, kDouble, kInt16, kInt32, kInt64, kByte, kChunk };

Storage StorageOf(int code) {
  const auto between = [code](int low, int high) { return code >= low && code <= high; };
  if (between(10, 59) || between(110, 149) || between(210, 239) || between(460, 469) ||
      between(1010, 1059)) {
    return Storage::kDouble;
  }
  if (between(60, 79) || between(170, 179) || between(270, 289) || between(370, 389) ||
      between(400, 409) || between(1060, 1070)) {
    return Storage::kInt16;
  }
  if (between(90, 99) || between(420, 429) || between(440, 459) || code == 1071) {
    return Storage::kInt32;
  }
  if (between(160, 169)) return Storage::kInt64;
  if (between(290, 299)) return Storage::kByte;
  if (between(310, 319) || code == 1004) return Storage::kChunk;
  return Storage::kText;
}

template <typename T>
void Write(T number, std::string* text) {
  char digits[40];
  text->append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
}

}  // namespace

DxfReader::DxfReader(const std::filesystem::path& path) : path_(path), code_page_("ANSI_1252") {
  stream_.open(path, std::ios::binary);
  if (!stream_ || !std::filesystem::is_regular_file(path)) {
    throw InputError(path, "cannot be read");
  }
  record_.file_ = &path_;
  record_.code_page_ = &code_page_;
  Refill();
  if (buffer_.starts_with("AC10")) {
    throw InputError(path, "is a DWG drawing, expected DXF: save it as such");
  }
  binary_ = buffer_.starts_with(kBinarySentinel);
  record_.binary_ = binary_;
  if (binary_) {
    next_ = kBinarySentinel.size();
    // Until R12 a group code was one byte: 0, then "SECTION".
    long_codes_ = !(buffer_.size() > next_ + 1 && buffer_[next_ + 1] != 0);
  } else {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (buffer_.starts_with(kByteOrderMark)) next_ = kByteOrderMark.size();
    if (buffer_.find('\n') == buffer_.npos && buffer_.find('\r') != buffer_.npos) line_end_ = '\r';
    CheckItsEnd();
  }
}

// A file that was cut is refused before anything in it is believed.
void DxfReader::CheckItsEnd() {
  const std::string_view begin = std::string_view(buffer_).substr(next_);
  const std::string_view first = Trimmed(begin.substr(0, begin.find(line_end_)));
  if (!begin.empty() && begin.find(line_end_) != begin.npos && !GroupCode(first)) {
    throw InputError(path_, 1, Quoted(first) + ", expected a DXF group code (an integer)");
  }
  std::ifstream file(path_, std::ios::binary);
  const auto size = static_cast<int64_t>(std::filesystem::file_size(path_));
  const int64_t length = std::min<int64_t>(size, 1 << 16);
  std::string tail(static_cast<size_t>(length), '\0');
  file.seekg(size - length);
  file.read(tail.data(), length);
  std::string_view rest = tail;
  std::string_view before;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(line_end_), rest.size());
    const std::string_view line = Trimmed(rest.substr(0, end));
    if (line == "EOF" && before == "0") return;
    before = line;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  int64_t lines = 0;
  file.clear();
  file.seekg(0);
  for (std::string line; std::getline(file, line, line_end_);) ++lines;
  line_ = lines;
  ThrowCutShort();
}

void DxfReader::ThrowCutShort() {
  const int64_t place = binary_ ? consumed_ + static_cast<int64_t>(buffer_.size()) : line_;
  throw DxfPlace{path_, binary_, place}.Error(
      "the drawing ends here, expected its EOF: it is cut short");
}

// Drops what was read and reads on; false: nothing more.
bool DxfReader::Refill() {
  consumed_ += static_cast<int64_t>(next_);
  buffer_.erase(0, next_);
  next_ = 0;
  const size_t kept = buffer_.size();
  buffer_.resize(kept + kBufferSize);
  stream_.read(buffer_.data() + kept, kBufferSize);
  buffer_.resize(kept + static_cast<size_t>(stream_.gcount()));
  return buffer_.size() > kept;
}

std::string_view DxfReader::ReadLine() {
  size_t end = 0;
  size_t from = next_;
  while ((end = buffer_.find(line_end_, from)) == std::string::npos) {
    const size_t pending = buffer_.size() - next_;
    if (pending > kLongestLine) {
      throw InputError(path_, static_cast<int>(line_ + 1), "is longer than any line of a drawing");
    }
    if (!Refill()) {
      if (buffer_.empty()) ThrowCutShort();
      end = buffer_.size();
      break;
    }
    from = pending;
  }
  const std::string_view line(buffer_.data() + next_, end - next_);
  next_ = std::min(end + 1, buffer_.size());
  ++line_;
  return Trimmed(line);
}

DxfReader::RawTag DxfReader::ReadTag() {
  if (binary_) return ReadBinaryTag();
  const std::string_view code_line = ReadLine();
  const std::optional<int> code = GroupCode(code_line);
  if (!code) {
    throw InputError(path_, static_cast<int>(line_),
                     Quoted(code_line) + ", expected a DXF group code (an integer)");
  }
  const std::string_view value = ReadLine();
  return TagOf(*code, buffer_, value, line_);
}

// `value` looks into `text`.
DxfReader::RawTag DxfReader::TagOf(int code, const std::string& text, std::string_view value,
                                   int64_t place) {
  if (value.empty()) return {code, value, place};
  const size_t first = static_cast<size_t>(value.data() - text.data());
  const size_t end = first + value.size();
  return {code, value, place, first > 0 && text[first - 1] == ' ',
          end < text.size() && text[end] == ' '};
}

std::string_view DxfReader::Take(size_t count) {
  while (buffer_.size() - next_ < count) {
    if (!Refill()) ThrowCutShort();
  }
  next_ += count;
  return std::string_view(buffer_).substr(next_ - count, count);
}

template <typename T>
T DxfReader::TakeNumber() {
  T number;
  std::memcpy(&number, Take(sizeof(T)).data(), sizeof(T));
  return number;
}

void DxfReader::AppendBinaryValue(int code, std::string* text) {
  switch (StorageOf(code)) {
    case Storage::kDouble:
      return Write(TakeNumber<double>(), text);
    case Storage::kInt16:
      return Write(TakeNumber<int16_t>(), text);
    case Storage::kInt32:
      return Write(TakeNumber<int32_t>(), text);
    case Storage::kInt64:
      return Write(TakeNumber<int64_t>(), text);
    case Storage::kByte:
      return Write(int{TakeNumber<uint8_t>()}, text);
    case Storage::kChunk: {
      constexpr char kDigits[] = "0123456789ABCDEF";
      const size_t count = TakeNumber<uint8_t>();
      for (const char c : Take(count)) {
        const auto byte = static_cast<unsigned char>(c);
        text->append({kDigits[byte >> 4], kDigits[byte & 15]});
      }
      return;
    }
    case Storage::kText:
      break;
  }
  for (char c; (c = Take(1)[0]) != '\0';) {
    text->push_back(c);
    if (text->size() > kLongestLine) {
      throw DxfPlace{path_, true, consumed_ + static_cast<int64_t>(next_)}.Error(
          "a text longer than any of a drawing");
    }
  }
}

DxfReader::RawTag DxfReader::ReadBinaryTag() {
  int code = 0;
  const auto here = [this] { return consumed_ + static_cast<int64_t>(next_); };
  const int64_t start = here();
  if (long_codes_) {
    code = TakeNumber<int16_t>();
  } else {
    code = TakeNumber<uint8_t>();
    if (code == 255) code = TakeNumber<int16_t>();  // extended data
  }
  if (code < kLowestCode || code > kHighestCode) {
    throw DxfPlace{path_, true, start}.Error(std::to_string(code) + ", expected a DXF group code");
  }
  const int64_t place = here();
  written_.clear();
  AppendBinaryValue(code, &written_);
  return TagOf(code, written_, Trimmed(written_), place);
}

void DxfReader::AddTag(const RawTag& tag) {
  offsets_.push_back(record_.text_.size());
  record_.text_.insert(record_.text_.end(), tag.value.begin(), tag.value.end());
  record_.tags_.push_back({tag.code, {}, tag.place, tag.has_blank_before, tag.has_blank_behind});
}

// The text no longer moves: now the tags can look into it.
void DxfReader::FinishRecord() {
  offsets_.push_back(record_.text_.size());
  for (size_t i = 0; i < record_.tags_.size(); ++i) {
    record_.tags_[i].value = {record_.text_.data() + offsets_[i], offsets_[i + 1] - offsets_[i]};
  }
}

const DxfRecord* DxfReader::Next() {
  if (at_eof_) return nullptr;
  record_.text_.clear();
  record_.tags_.clear();
  offsets_.clear();
  if (has_first_) AddTag({.code = 0, .value = first_value_, .place = first_place_});
  for (;;) {
    const RawTag tag = ReadTag();
    if (tag.code == kComment) continue;
    if (record_.tags_.empty() && tag.code != 0) {
      const int64_t place = binary_ ? tag.place : tag.place - 1;
      throw DxfPlace{path_, binary_, place}.Error(
          "a drawing begins with group code 0 (SECTION), not with " + std::to_string(tag.code));
    }
    if (tag.code == 0 && !record_.tags_.empty()) {
      first_value_ = tag.value;
      first_place_ = tag.place;
      has_first_ = true;
      break;
    }
    AddTag(tag);
    if (tag.code == 0 && tag.value == "EOF") break;
  }
  at_eof_ = record_.tags_.front().code == 0 && has_first_ && first_value_ == "EOF";
  FinishRecord();
  return record_.tags_.size() == 1 && record_.kind() == "EOF" ? nullptr : &record_;
}

}  // namespace insitu
