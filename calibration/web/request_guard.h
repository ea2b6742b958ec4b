// SPDX-License-Identifier: GPL-3.0-or-later
// Who may ask: a server on this machine is within reach of every web page that its user visits.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insitu {

struct HeaderField {
  std::string name;  // in small letters
  std::string value;
};

// What counts of a request before its body is read.
struct RequestHead {
  enum class Kind {
    kPublic,     // a resource without data
    kToken,      // anything else
    kWebSocket,  // brings the token as its first message
  };
  Kind kind = Kind::kToken;
  std::vector<HeaderField> fields;
};

struct Refusal {
  int status = 403;
  std::string reason;
};

// nullopt: admitted. Refused are other names for this machine (DNS rebinding), pages of other
// origins, and whoever does not know the token.
std::optional<Refusal> RefusalOf(const RequestHead& head, std::string_view token);

// Takes as long wherever the two differ.
bool IsSameSecret(std::string_view a, std::string_view b);

// 128 random bits of the operating system, hexadecimal.
std::string NewToken();

}  // namespace insitu
