// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_name.h"

#include <iconv.h>

#include <charconv>
#include <cstdint>
#include <map>
#include <optional>

namespace insitu {
namespace {

// iconv's names of AutoCAD's code pages ($DWGCODEPAGE, in capitals).
std::string IconvName(const std::string& code_page) {
  static const std::map<std::string, std::string> kOthers = {
      {"UTF-8", "UTF-8"},          {"MACINTOSH", "MACINTOSH"}, {"DOS437", "CP437"},
      {"DOS850", "CP850"},         {"DOS852", "CP852"},        {"DOS855", "CP855"},
      {"DOS857", "CP857"},         {"DOS860", "CP860"},        {"DOS861", "CP861"},
      {"DOS863", "CP863"},         {"DOS865", "CP865"},        {"DOS866", "CP866"},
      {"ISO8859-1", "ISO-8859-1"}, {"JOHAB", "JOHAB"},         {"KSC5601", "CP949"},
      {"GB2312", "CP936"},         {"BIG5", "CP950"}};
  std::string name = code_page;
  for (char& c : name) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  if (name.starts_with("ANSI_")) return "CP" + name.substr(5);
  const auto other = kOthers.find(name);
  return other == kOthers.end() ? "CP1252" : other->second;
}

class Converter {
 public:
  explicit Converter(const std::string& encoding) : handle_(iconv_open("UTF-8", encoding.c_str())) {
    if (!IsOpen()) handle_ = iconv_open("UTF-8", "CP1252");
  }
  ~Converter() {
    if (IsOpen()) iconv_close(handle_);
  }
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;

  // What stands for no character becomes U+FFFD.
  std::string ToUtf8(std::string_view text) {
    if (!IsOpen()) return std::string(text);
    iconv(handle_, nullptr, nullptr, nullptr, nullptr);
    std::string utf8(4 * text.size() + 4, '\0');
    char* in = const_cast<char*>(text.data());
    size_t left = text.size();
    std::string result;
    while (left > 0) {
      char* out = utf8.data();
      size_t room = utf8.size();
      const size_t status = iconv(handle_, &in, &left, &out, &room);
      result.append(utf8.data(), out);
      if (status != static_cast<size_t>(-1) || left == 0) break;
      result += "\xEF\xBF\xBD";
      ++in;
      --left;
    }
    return result;
  }

 private:
  // iconv_open's failure is -1 as a pointer.
  bool IsOpen() const { return reinterpret_cast<intptr_t>(handle_) != -1; }
  iconv_t handle_;
};

void AppendUtf8(uint32_t code_point, std::string* text) {
  const auto append = [text](uint32_t byte) { text->push_back(static_cast<char>(byte)); };
  if (code_point < 0x80) {
    append(code_point);
  } else if (code_point < 0x800) {
    append(0xC0 | code_point >> 6);
    append(0x80 | (code_point & 0x3F));
  } else {
    append(0xE0 | code_point >> 12);
    append(0x80 | (code_point >> 6 & 0x3F));
    append(0x80 | (code_point & 0x3F));
  }
}

// Length of the UTF-8 character at the front of `text`; 0 if there is none.
size_t Utf8Length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const size_t length = lead < 0x80                    ? 1
                        : lead >= 0xC2 && lead <= 0xDF ? 2
                        : lead >= 0xE0 && lead <= 0xEF ? 3
                        : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                       : 0;
  if (length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

bool IsUtf8(std::string_view text) {
  while (!text.empty()) {
    const size_t length = Utf8Length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::optional<uint32_t> Hexadecimal(std::string_view text, size_t first, size_t digits) {
  if (text.size() < first + digits) return std::nullopt;
  uint32_t value = 0;
  const char* const end = text.data() + first + digits;
  const auto result = std::from_chars(text.data() + first, end, value, 16);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

// The character of "\U+XXXX" at the front of `text`.
std::optional<uint32_t> EscapedCharacter(std::string_view text) {
  if (!text.starts_with("\\U+")) return std::nullopt;
  const auto code_point = Hexadecimal(text, 3, 4);
  const bool surrogate = code_point && *code_point >= 0xD800 && *code_point < 0xE000;
  return surrogate ? std::nullopt : code_point;
}

// "\M+nXXXX": two bytes of a far-eastern code page, 1 to 5.
std::optional<std::string> EscapedBytes(std::string_view text) {
  constexpr const char* kPages[] = {"CP932", "CP950", "CP949", "JOHAB", "CP936"};
  if (!text.starts_with("\\M+") || text.size() < 8 || text[3] < '1' || text[3] > '5') {
    return std::nullopt;
  }
  const auto code = Hexadecimal(text, 4, 4);
  if (!code) return std::nullopt;
  const char bytes[2] = {static_cast<char>(*code >> 8), static_cast<char>(*code & 255)};
  return Converter(kPages[text[3] - '1']).ToUtf8({bytes, 2});
}

}  // namespace

std::string Utf8FromDxf(std::string_view text, const std::string& code_page) {
  const std::string encoded =
      IsUtf8(text) ? std::string(text) : Converter(IconvName(code_page)).ToUtf8(text);
  if (encoded.find('\\') == std::string::npos) return encoded;
  std::string name;
  for (size_t i = 0; i < encoded.size();) {
    const std::string_view rest = std::string_view(encoded).substr(i);
    if (const auto character = EscapedCharacter(rest)) {
      AppendUtf8(*character, &name);
      i += 7;
    } else if (const auto characters = EscapedBytes(rest)) {
      name += *characters;
      i += 8;
    } else {
      name.push_back(encoded[i++]);
    }
  }
  return name;
}

}  // namespace insitu
