// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/web_request.h"

#include <json/value.h>
#include <json/writer.h>

#include <algorithm>
#include <charconv>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

bool IsNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.';
}

bool IsPlainPath(std::string_view path) {
  if (!path.starts_with('/')) return false;
  char before = '\0';
  for (const char c : path) {
    if (c != '/' && !IsNameCharacter(c)) return false;
    if (before == '/' && (c == '/' || c == '.')) return false;
    before = c;
  }
  return true;
}

std::optional<std::string> Decoded(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    if (i + 3 > text.size()) return std::nullopt;
    unsigned char byte = 0;
    const char* const digits = text.data() + i + 1;
    if (std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2 || byte == 0) {
      return std::nullopt;
    }
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

// "name=value"; false if it cannot be decoded or the name was there before.
bool AddParameter(std::string_view text, std::map<std::string, std::string>* query) {
  const size_t sign = std::min(text.find('='), text.size());
  const auto name = Decoded(text.substr(0, sign));
  const auto value = Decoded(text.substr(std::min(sign + 1, text.size())));
  return name && value && query->emplace(*name, *value).second;
}

}  // namespace

std::optional<WebRequest> ParseTarget(std::string_view target) {
  const size_t mark = std::min(target.find('?'), target.size());
  WebRequest request;
  request.path = target.substr(0, mark);
  if (!IsPlainPath(request.path)) return std::nullopt;
  std::string_view rest = target.substr(std::min(mark + 1, target.size()));
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('&'), rest.size());
    if (!AddParameter(rest.substr(0, end), &request.query)) return std::nullopt;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return request;
}

int QueryInteger(const WebRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  if (found == request.query.end()) {
    throw InputError(request.path, "has no '" + name + "', expected a whole number");
  }
  const std::string& text = found->second;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  throw InputError(request.path, "'" + name + "' is " + Quoted(text) + ", expected a whole number");
}

WebResponse ErrorResponse(int status, const std::string& text) {
  return ErrorResponse(status, Sentence::Verbatim(text));
}

WebResponse ErrorResponse(int status, const Sentence& sentence) {
  Json::Value message;
  sentence.SayIn(&message, "error");
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "";
  WebResponse response;
  response.status = status;
  response.body = Json::writeString(builder, message);
  return response;
}

}  // namespace insitu
