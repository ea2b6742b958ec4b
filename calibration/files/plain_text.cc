// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/plain_text.h"

#include <unicode/uchar.h>
#include <unicode/unorm2.h>
#include <unicode/ustring.h>
#include <unicode/utf16.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

constexpr size_t kGuessedBytes = 256;  // enough of a text to see the zeros of UTF-16
constexpr auto kLargestText = static_cast<size_t>(std::numeric_limits<int32_t>::max()) / 4;

// What Windows-1252 has from 0x80 to 0x9F; 0: nothing.
constexpr char16_t kWindows[32] = {0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                   0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                   0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                   0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

std::string Utf8(const std::u16string& text) {
  std::string utf8(3 * text.size() + 1, '\0');
  int32_t length = 0;
  UErrorCode status = U_ZERO_ERROR;
  u_strToUTF8(utf8.data(), static_cast<int32_t>(utf8.size()), &length, text.data(),
              static_cast<int32_t>(text.size()), &status);
  INSITU_CHECK(U_SUCCESS(status));
  utf8.resize(static_cast<size_t>(length));
  return utf8;
}

// nullopt: no UTF-8.
std::optional<std::u16string> Utf16(std::string_view utf8) {
  std::u16string text(utf8.size() + 1, u'\0');
  int32_t length = 0;
  UErrorCode status = U_ZERO_ERROR;
  u_strFromUTF8(text.data(), static_cast<int32_t>(text.size()), &length, utf8.data(),
                static_cast<int32_t>(utf8.size()), &status);
  if (U_FAILURE(status)) return std::nullopt;
  text.resize(static_cast<size_t>(length));
  return text;
}

enum class Order { kNone, kLittle, kBig };

// Of UTF-16: by its mark, or since every second byte of the first letters is zero.
Order OrderOf(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return Order::kLittle;
  if (bytes.starts_with("\xFE\xFF")) return Order::kBig;
  const std::string_view start = bytes.substr(0, kGuessedBytes);
  size_t zeros[2] = {0, 0};
  for (size_t i = 0; i < start.size(); ++i) zeros[i % 2] += start[i] == '\0';
  const size_t letters = start.size() / 2;
  if (letters < 4 || zeros[0] + zeros[1] < letters / 2) return Order::kNone;
  if (zeros[0] == 0) return Order::kLittle;
  return zeros[1] == 0 ? Order::kBig : Order::kNone;
}

std::string FromUtf16(const std::filesystem::path& path, std::string_view bytes, Order order) {
  if (bytes.size() % 2 != 0) throw InputError(path, "is UTF-16 cut short, expected UTF-8");
  std::u16string text;
  for (size_t i = 0; i < bytes.size(); i += 2) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    const auto second = static_cast<unsigned char>(bytes[i + 1]);
    const int unit = order == Order::kLittle ? first | second << 8 : second | first << 8;
    if (unit != 0xFEFF) text += static_cast<char16_t>(unit);
  }
  for (size_t i = 0; i < text.size(); ++i) {
    if (!U16_IS_SURROGATE(text[i])) continue;
    const bool is_pair =
        U16_IS_SURROGATE_LEAD(text[i]) && i + 1 < text.size() && U16_IS_TRAIL(text[i + 1]);
    if (!is_pair) throw InputError(path, "is broken UTF-16, expected UTF-8");
    ++i;
  }
  return Utf8(text);
}

std::string FromWindows(std::string_view bytes) {
  std::u16string text;
  for (const char byte : bytes) {
    const auto code = static_cast<unsigned char>(byte);
    const bool is_special = code >= 0x80 && code < 0xA0;
    text += is_special ? kWindows[code - 0x80] : static_cast<char16_t>(code);
  }
  return Utf8(text);
}

std::string WithLineFeeds(std::string text) {
  if (text.find('\r') == std::string::npos) return text;
  size_t end = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool is_return = text[i] == '\r';
    if (is_return && i + 1 < text.size() && text[i + 1] == '\n') continue;
    text[end++] = is_return ? '\n' : text[i];
  }
  text.resize(end);
  return text;
}

bool IsAscii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; });
}

std::u16string Normalized(const std::u16string& text, const UNormalizer2* form) {
  std::u16string normal(4 * text.size() + 16, u'\0');
  UErrorCode status = U_ZERO_ERROR;
  for (int attempt = 0; attempt < 2; ++attempt) {
    status = U_ZERO_ERROR;
    const int32_t length =
        unorm2_normalize(form, text.data(), static_cast<int32_t>(text.size()), normal.data(),
                         static_cast<int32_t>(normal.size()), &status);
    if (status == U_BUFFER_OVERFLOW_ERROR) {
      normal.resize(static_cast<size_t>(length) + 1);
      continue;
    }
    normal.resize(static_cast<size_t>(std::max(length, 0)));
    break;
  }
  return U_SUCCESS(status) ? normal : text;
}

}  // namespace

std::string ReadPlainText(const std::filesystem::path& path) {
  return PlainText(path, ReadWhole(path));
}

std::string PlainText(const std::filesystem::path& path, std::string bytes) {
  if (bytes.size() > kLargestText)
    throw InputError(path, "is larger than 500 MB, expected a table");
  const Order order = OrderOf(bytes);
  if (order != Order::kNone) bytes = FromUtf16(path, bytes, order);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  if (bytes.find('\0') != std::string::npos) {
    throw InputError(path, "is not a text file (it holds a zero byte)");
  }
  if (!IsAscii(bytes)) bytes = Utf16(bytes) ? Composed(bytes) : Composed(FromWindows(bytes));
  if (bytes.find('\0') != std::string::npos) {
    throw InputError(path, "is not a text file (neither UTF-8 nor Windows-1252)");
  }
  return WithLineFeeds(std::move(bytes));
}

std::string Composed(const std::string& utf8) {
  if (IsAscii(utf8)) return utf8;
  UErrorCode status = U_ZERO_ERROR;
  const UNormalizer2* form = unorm2_getNFCInstance(&status);
  const auto text = Utf16(utf8);
  return text && U_SUCCESS(status) ? Utf8(Normalized(*text, form)) : utf8;
}

bool IsUtf8(const std::string& text) { return IsAscii(text) || Utf16(text).has_value(); }

std::string InCapitals(const std::string& utf8) {
  std::string capitals = utf8;
  if (IsAscii(utf8)) {
    for (char& c : capitals) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return capitals;
  }
  const auto text = Utf16(Composed(utf8));
  if (!text) return utf8;
  std::u16string upper(3 * text->size() + 1, u'\0');  // a letter becomes at most three
  UErrorCode status = U_ZERO_ERROR;
  const int32_t length =
      u_strToUpper(upper.data(), static_cast<int32_t>(upper.size()), text->data(),
                   static_cast<int32_t>(text->size()), "", &status);
  if (U_FAILURE(status)) return utf8;
  upper.resize(static_cast<size_t>(length));
  return Utf8(upper);
}

bool IsNoNumber(std::string_view word) {
  while (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  const auto begins = [&](std::string_view text) {
    return std::ranges::equal(word.substr(0, text.size()), text, {}, [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
  };
  return begins("nan") || begins("inf") || word.starts_with("1.#");
}

std::string Folded(const std::string& utf8) {
  UErrorCode status = U_ZERO_ERROR;
  const UNormalizer2* form = unorm2_getNFKDInstance(&status);
  const auto text = Utf16(utf8);
  if (!text || U_FAILURE(status)) return utf8;
  std::u16string folded;
  for (const char16_t unit : Normalized(*text, form)) {
    if (u_charType(unit) == U_NON_SPACING_MARK) continue;
    const auto lower = static_cast<char16_t>(U16_IS_SURROGATE(unit) ? unit : u_tolower(unit));
    folded += lower;
  }
  return Utf8(folded);
}

}  // namespace insitu
