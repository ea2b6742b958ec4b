// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/acis_file.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <utility>

namespace insitu {
namespace {

using Kind = AcisToken::Kind;

constexpr std::string_view kBlanks = " \t\r\n";

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsEndMark(std::string_view type) {
  return type.starts_with("End-of-") || type.starts_with("Begin-of-");
}

template <typename T>
std::optional<T> NumberIn(std::string_view word) {
  T number{};
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (status != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

AcisToken TokenOf(std::string_view word) {
  if (word.starts_with('$')) {
    const auto index = NumberIn<int>(word.substr(1));
    if (index) return {Kind::kReference, static_cast<double>(*index), ""};
  }
  if (const auto number = NumberIn<double>(word)) return {Kind::kNumber, *number, ""};
  return {Kind::kWord, 0, std::string(word)};
}

class SatReader {
 public:
  explicit SatReader(std::string_view text) : rest_(text) {}

  std::optional<AcisFile> Read() {
    AcisFile file;
    const std::string_view head = Line();
    const size_t begin = std::min(head.find_first_not_of(kBlanks), head.size());
    const size_t end = std::min(head.find_first_of(kBlanks, begin), head.size());
    const auto version = NumberIn<int>(head.substr(begin, end - begin));
    if (!version) return std::nullopt;
    file.version = *version;
    // Product, date, tolerances: lines that begin with a number or a counted text.
    for (std::string_view before = rest_;; before = rest_) {
      const std::string_view line = Line();
      const size_t first = line.find_first_not_of(kBlanks);
      const bool is_head = first != line.npos && (IsDigit(line[first]) || line[first] == '@');
      if (is_head) continue;
      rest_ = before;
      break;
    }
    while (ReadRecord(&file)) {
    }
    return file;
  }

 private:
  std::string_view Line() {
    const size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return line;
  }

  std::string_view Word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  // "@7 unknown": a text of seven characters, which may be blanks or end marks.
  std::optional<AcisToken> Counted(std::string_view word) {
    if (!word.starts_with('@')) return std::nullopt;
    const auto count = NumberIn<size_t>(word.substr(1));
    if (!count || *count + 1 > rest_.size()) return std::nullopt;
    AcisToken token{Kind::kWord, 0, std::string(rest_.substr(1, *count))};
    rest_.remove_prefix(*count + 1);
    return token;
  }

  bool ReadRecord(AcisFile* file) {
    std::string_view word = Word();
    if (word.size() > 1 && word[0] == '-' && IsDigit(word[1])) word = Word();  // its number
    if (word.empty() || IsEndMark(word)) return false;
    AcisRecord record{std::string(word), {}};
    for (word = Word(); word != "#"; word = Word()) {
      if (word.empty()) return false;
      const auto counted = Counted(word);
      record.tokens.push_back(counted ? *counted : TokenOf(word));
    }
    file->records.push_back(std::move(record));
    return true;
  }

  std::string_view rest_;
};

class SabReader {
 public:
  explicit SabReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<AcisFile> Read() {
    constexpr size_t kSignature = 15;
    const std::string_view signature = rest_.substr(0, kSignature);
    if (!signature.starts_with("ACIS BinaryFile") && !signature.starts_with("ASM BinaryFile")) {
      return std::nullopt;
    }
    is_wide_ = signature.ends_with('8');
    rest_.remove_prefix(kSignature);
    AcisFile file;
    file.version = static_cast<int>(Integer());
    for (int i = 0; i < 3; ++i) Integer();  // counts, flags
    while (!rest_.empty() && ReadToken(&file)) {
    }
    if (is_cut_) return std::nullopt;
    return file;
  }

 private:
  template <typename T>
  T Plain() {
    T value{};
    if (rest_.size() < sizeof(T)) {
      is_cut_ = true;
      rest_ = {};
      return value;
    }
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  int64_t Integer() { return is_wide_ ? Plain<int64_t>() : Plain<int32_t>(); }

  std::string_view Text(size_t size) {
    if (size > rest_.size()) is_cut_ = true;
    const std::string_view text = rest_.substr(0, size);
    rest_.remove_prefix(text.size());
    return text;
  }

  void Add(Kind kind, double number, std::string_view word = {}) {
    record_.tokens.push_back({kind, number, std::string(word)});
  }
  void AddDoubles(int count) {
    for (int i = 0; i < count; ++i) Add(Kind::kNumber, Plain<double>());
  }
  // A transform is a line of text.
  void AddWords(std::string_view text) {
    while (!text.empty()) {
      const size_t end = std::min(text.find(' '), text.size());
      if (end > 0) record_.tokens.push_back(TokenOf(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  // False: at the end mark, or a tag that is not known.
  bool ReadToken(AcisFile* file) {
    const int tag = Plain<uint8_t>();
    if (AddNumber(tag) || AddText(tag)) return true;
    switch (tag) {
      case 0x0A:
      case 0x0B:
        Add(Kind::kFlag, tag == 0x0A ? 1 : 0);
        return true;
      case 0x0C:
        Add(Kind::kReference, static_cast<double>(Integer()));
        return true;
      case 0x0D:
        return AddName(std::string(Text(Plain<uint8_t>())));
      case 0x0E:
        name_ += std::string(Text(Plain<uint8_t>())) + "-";
        return true;
      case 0x11:
        file->records.push_back(std::move(record_));
        record_ = {};
        return true;
      default:
        is_cut_ = true;
        return false;
    }
  }

  // False: another tag.
  bool AddNumber(int tag) {
    if (tag == 0x02) {
      Add(Kind::kNumber, Plain<uint8_t>());
    } else if (tag == 0x03) {
      Add(Kind::kNumber, Plain<int16_t>());
    } else if (tag == 0x04 || tag == 0x15) {
      Add(Kind::kNumber, static_cast<double>(Integer()));
    } else if (tag == 0x05) {
      Add(Kind::kNumber, Plain<float>());
    } else if (tag == 0x06) {
      AddDoubles(1);
    } else if (tag == 0x13 || tag == 0x14) {
      AddDoubles(3);
    } else if (tag == 0x16) {
      AddDoubles(2);
    } else if (tag == 0x17) {
      Add(Kind::kNumber, static_cast<double>(Plain<int64_t>()));
    } else {
      return false;
    }
    return true;
  }

  bool AddText(int tag) {
    if (tag == 0x07) {
      Add(Kind::kWord, 0, Text(Plain<uint8_t>()));
    } else if (tag == 0x08) {
      Add(Kind::kWord, 0, Text(Plain<uint16_t>()));
    } else if (tag == 0x09 || tag == 0x12) {
      AddWords(Text(Plain<uint32_t>()));
    } else if (tag == 0x0F || tag == 0x10) {
      Add(Kind::kWord, 0, tag == 0x0F ? "{" : "}");
    } else {
      return false;
    }
    return true;
  }

  // The first name is the record's type; what came before it is the file's head.
  bool AddName(std::string name) {
    name = std::exchange(name_, {}) + name;
    if (IsEndMark(name)) return false;
    if (record_.type.empty()) {
      record_ = {std::move(name), {}};
    } else {
      Add(Kind::kWord, 0, name);
    }
    return true;
  }

  std::string_view rest_;
  std::string name_;
  AcisRecord record_;
  bool is_wide_ = false, is_cut_ = false;
};

}  // namespace

bool AcisFile::Is(int record, std::string_view type) const {
  if (record < 0 || record >= std::ssize(records)) return false;
  const std::string_view own = records[record].type;
  return own.ends_with(type) &&
         (own.size() == type.size() || own[own.size() - type.size() - 1] == '-');
}

std::vector<int> AcisFile::References(int record, std::string_view type) const {
  std::vector<int> found;
  for (const AcisToken& token : records[record].tokens) {
    if (token.kind != Kind::kReference) continue;
    if (Is(static_cast<int>(token.number), type)) found.push_back(static_cast<int>(token.number));
  }
  return found;
}

int AcisFile::First(int record, std::string_view type) const {
  if (record < 0) return -1;
  for (const AcisToken& token : records[record].tokens) {
    if (token.kind != Kind::kReference) continue;
    if (Is(static_cast<int>(token.number), type)) return static_cast<int>(token.number);
  }
  return -1;
}

std::string DecodedAcisText(std::string_view text) {
  constexpr int kMiddle = 159;
  std::string decoded(text);
  for (char& c : decoded) {
    if (c > ' ' && c < 127) c = static_cast<char>(kMiddle - c);
  }
  return decoded;
}

std::optional<AcisFile> ReadSat(std::string_view text) { return SatReader(text).Read(); }

std::optional<AcisFile> ReadSab(std::string_view bytes) { return SabReader(bytes).Read(); }

}  // namespace insitu
