// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/request_guard.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

// Fields that decide: twice in a request, they would be read one way here and another elsewhere.
constexpr std::array kDeciding = {"host",           "origin",         "authorization",
                                  "sec-fetch-site", "sec-fetch-mode", "sec-fetch-dest"};

size_t Count(const RequestHead& head, std::string_view name) {
  return std::count_if(head.fields.begin(), head.fields.end(),
                       [&](const HeaderField& field) { return field.name == name; });
}

std::optional<std::string> Find(const RequestHead& head, std::string_view name) {
  for (const HeaderField& field : head.fields) {
    if (field.name == name) return field.value;
  }
  return std::nullopt;
}

bool IsPort(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Any port: "ssh -L" changes it.
bool IsThisMachine(std::string_view host) {
  for (const std::string_view name : {"127.0.0.1", "localhost", "[::1]"}) {
    if (!host.starts_with(name)) continue;
    const std::string_view rest = host.substr(name.size());
    return rest.empty() || (rest[0] == ':' && IsPort(rest.substr(1)));
  }
  return false;
}

// The page itself may be opened from anywhere, as from the file that open_browser writes: it holds
// nothing, and cannot be framed.
bool OpensThePage(const RequestHead& head) {
  return head.kind == RequestHead::Kind::kPublic && Find(head, "sec-fetch-mode") == "navigate" &&
         Find(head, "sec-fetch-dest") == "document";
}

std::optional<Refusal> OriginRefusal(const RequestHead& head, const std::string& host) {
  const bool is_websocket = head.kind == RequestHead::Kind::kWebSocket;
  const std::optional<std::string> origin = Find(head, "origin");
  if (!origin && is_websocket) return Refusal{403, "a WebSocket must name its origin"};
  if (origin && *origin != "http://" + host) {
    return Refusal{403, "pages of " + Quoted(*origin) + " are not served"};
  }
  if (is_websocket) return std::nullopt;  // browsers differ in what ws: is the same site as
  const std::optional<std::string> site = Find(head, "sec-fetch-site");
  if (!site || *site == "same-origin" || *site == "none" || OpensThePage(head)) return std::nullopt;
  return Refusal{403, "pages of other sites are not served"};
}

}  // namespace

std::optional<Refusal> RefusalOf(const RequestHead& head, std::string_view token) {
  for (const char* const name : kDeciding) {
    if (Count(head, name) > 1) return Refusal{400, std::string(name) + " is there twice"};
  }
  const std::optional<std::string> host = Find(head, "host");
  if (!host || !IsThisMachine(*host)) {
    return Refusal{403, "expected 127.0.0.1, localhost or [::1] as the host"};
  }
  if (auto refusal = OriginRefusal(head, *host)) return refusal;
  if (head.kind != RequestHead::Kind::kToken) return std::nullopt;
  const std::string authorization = Find(head, "authorization").value_or("");
  if (IsSameSecret(authorization, "Bearer " + std::string(token))) return std::nullopt;
  return Refusal{401,
                 "the token is missing or another session's: open the page by the address "
                 "that the program prints"};
}

bool IsSameSecret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^
                  static_cast<unsigned char>(b.empty() ? '\0' : b[i % b.size()]);
  }
  return difference == 0;
}

std::string NewToken() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the operating system gives no random numbers");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += Formatted("%02x", byte);
  return token;
}

}  // namespace insitu
